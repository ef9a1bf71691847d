#pragma once

#include "mane/vec.h"
#include "strands/drawn_envelope.h"
#include "strands/recipe.h"
#include "strands/vertex_grid.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mane {

/// What the strands of one wisp are drawn from, in one frame.
struct WispToDraw {
    const DrawnEnvelope& envelope;
    const StrandRecipes& recipes;
    const VertexGrid& grid;
    std::size_t wisp = 0;
    std::size_t first_strand = 0;        ///< the wisp's
    float root_width = 0, tip_width = 0; ///< [m]

    /// Where the strands move along the wisp: at the grid's vertices, the waves' displacement for
    /// a strand's own phase 0 and π/2, and the cosine and sine of the curls' turn; at the ends of
    /// the strands that are drawn, from the first on, the waves' amplitude.
    DiscPoint wave_direction{};
    const float *wave_sine = nullptr, *wave_cosine = nullptr;
    const float *curl_cosine = nullptr, *curl_sine = nullptr;
    const float* end_amplitude = nullptr;
};

/// A wisp's curves at the vertices of its grid: rows of x, y, z of the centre, then of each half
/// line's end.
struct GridRows {
    AlignedVector<float> rows;
    std::size_t stride = 0;
};

/// The kernels of one instruction set.
struct StrandKernels {
    /// The curves of the wisp at the vertices of its grid.
    void (*lay_grid)(const WispToDraw& wisp, GridRows& rows);
    /// Strands `first` … `first + count − 1` of all, which are the wisp's, into their vertices.
    void (*draw)(const WispToDraw& wisp, const GridRows& rows, std::size_t first, std::size_t count,
                 Vec3* positions, float* widths);
};
/// Of the named instruction set, or of the best of the machine for "".
StrandKernels strand_kernels(const std::string& instruction_set);

} // namespace mane
