#pragma once

#include "base/aligned.h"
#include "base/parallel_for.h"
#include "mane/desc.h"
#include "strands/designed_length.h"
#include "strands/drawn_envelope.h"
#include "strands/strand_layout.h"
#include "strands/vertex_grid.h"
#include "strands/waves.h"

#include <cstdint>
#include <vector>

namespace mane {

/// The order in which a strand takes its random numbers.
enum StrandNumber : std::uint64_t { kPlace, kPlaceAngle, kLength, kPhase, kFirstJitter };

/// Every strand's own recipe: everything random about it, and nothing that a frame changes. Columns
/// with an entry per strand; any of them may be read kPadding entries too far.
struct StrandRecipes {
    static constexpr std::size_t kPadding = 16;
    template <typename T> using Column = AlignedVector<T>;

    StrandRecipes(const StrandDesc& desc, std::uint32_t seed, const StrandLayout& layout,
                  const DesignedLength& designed, const DrawnEnvelope& envelope, const Waves& waves,
                  const VertexGrid& grid, Threads& threads);

    /// Whether waves or curls move a strand's place in the disc along it.
    bool moving;
    /// Whether there is jitter.
    bool jittered;

    /// Where the strand stands in the disc: x and y; where nothing moves it, α and β in the sector
    /// that begins with half line `sector`.
    Column<float> first, second;
    Column<std::uint32_t> sector;
    Column<float> phase_cosine, phase_sine; ///< of its own part of the waves' phase

    Column<float> end;                      ///< p
    Column<float> end_piece, end_weight[4]; ///< its whole part, and the Catmull-Rom curves there
    Column<float> end_x, end_y; ///< place in the disc there, jitter and curls counted, waves not
    Column<float> end_wave;     ///< sine of the waves' phase there
    Column<std::size_t> vertex; ///< index of its first; and one entry behind the last strand

    /// What jitter leaves of the distance from the skeleton in each section: pieces + 3 entries per
    /// strand, the first and the last section's twice.
    Column<float> left;
    Column<std::size_t> first_left; ///< per wisp, of its first strand's
};

} // namespace mane
