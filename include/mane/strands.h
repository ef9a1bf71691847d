#pragma once

#include "mane/body.h"
#include "mane/curves.h"
#include "mane/desc.h"
#include "mane/frame.h"
#include "mane/groom.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mane {

/// How strands are drawn; changes no result.
struct StrandOptions {
    unsigned threads = 1;             ///< 0: as many as the machine has
    std::string instruction_set = {}; ///< "": the best of the machine; else as in `RunOptions`
};

/// Layer 3 (§3.4, §5.2): the strands of a groom, a pure function of (groom, frame, desc, seed,
/// strand number). Any strand of any frame can be made alone, in parallel, with the same bits
/// (M15).
///
/// Strands are numbered wisp after wisp; `desc.count` strands are spread over the wisps in
/// proportion to `groom.strands`. A strand begins at x₀, inside the head, so that it comes out of
/// the skin and not out of the air above it; its vertex `outside_vertex()` is in the cross-section
/// of x₁, from where on it shows. A wisp's strands have vertices at the same places along it, each
/// up to its own end, where its last one is. Which and how many they are does not change from
/// frame to frame.
class StrandShape {
  public:
    /// Makes the strands' recipes: all that no frame changes. Copies what it needs. Throws
    /// InputError for no samples or a wisp of fewer than three sections.
    StrandShape(const Groom& groom, const StrandDesc& desc, std::uint32_t seed,
                std::uint32_t samples_per_segment = 4, const StrandOptions& options = {});
    ~StrandShape();
    StrandShape(StrandShape&&) noexcept;
    StrandShape& operator=(StrandShape&&) noexcept;

    /// The frame to draw from now on. Throws InputError for one that does not fit the groom.
    void pose(const Frame& frame);

    std::size_t strand_count() const;
    /// Vertices of all strands.
    std::size_t vertex_count() const;
    /// Index of a strand's first vertex; of `strand_count()`: the number of all vertices.
    std::size_t first_vertex(std::size_t strand) const;
    std::uint32_t wisp(std::size_t strand) const;
    std::uint32_t outside_vertex() const;
    /// Where a vertex is along its wisp: i + t is the share t of the way from section i to i + 1.
    float parameter(std::size_t strand, std::uint32_t vertex) const;

    /// Fills the vertices of the strands first … first + count − 1, one after the other:
    /// `positions` [m] relative to the frame's origin, `widths` [m] diameters; both have
    /// first_vertex(first + count) − first_vertex(first) entries. May be called by several threads
    /// at once. Throws InputError for other sizes, or when nothing has been posed.
    void fill(std::size_t first, std::size_t count, std::span<Vec3> positions,
              std::span<float> widths) const;
    /// The same for all strands, on the threads of the options; by one caller at a time.
    void fill(std::span<Vec3> positions, std::span<float> widths) const;
    /// All strands in memory of their own, made likewise.
    Curves curves() const;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// The drawn envelope of one wisp, to judge strands by (M17): from a point to its place, in
/// doubles, where drawing goes from a place to its point.
class EnvelopeGauge {
  public:
    EnvelopeGauge(const Groom& groom, const Frame& frame, std::size_t wisp);

    /// How deep `point` [m] is in the cross-section at `p` (as `StrandShape::parameter`): 0 on the
    /// skeleton, 1 on the surface, more outside. Infinite if it is in none of the section's
    /// sectors, to `tolerance` [m].
    double depth(const Vec3d& point, double p, double tolerance = 2e-6) const;

  private:
    template <typename Points> Vec3d curve(double p, Points points) const;

    std::size_t half_lines_;
    std::vector<Vec3d> centre_; // per section
    std::vector<Vec3d> end_;    // sections × K: of the half lines, relative to the centre
};

/// All strands of a frame at once, on `threads` threads (0: as many as the machine has).
Curves make_strands(const Groom& groom, const Frame& frame, const StrandDesc& desc,
                    std::uint32_t seed, std::uint32_t samples_per_segment = 4,
                    unsigned threads = 1);

/// The skeletons, smooth as drawn: one curve per wisp, from x₀; width is the mean diameter of the
/// envelope there.
Curves skeleton_curves(const Groom& groom, const Frame& frame,
                       std::uint32_t samples_per_segment = 1);

/// The drawn envelope (M14a): a closed surface per wisp, one after the other, with `points_round`
/// vertices in a section, relative to the frame's origin.
Mesh envelope_mesh(const Groom& groom, const Frame& frame, std::uint32_t samples_per_segment = 4,
                   std::uint32_t points_round = 16);

} // namespace mane
