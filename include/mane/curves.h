#pragma once

#include "mane/vec.h"

#include <cstdint>
#include <vector>

namespace mane {

/// Strands as curves with widths (§5.2): strand s owns the vertices first_vertex[s] …
/// first_vertex[s+1]−1, root to tip.
struct Curves {
    std::vector<std::uint32_t> first_vertex; ///< strands + 1 entries
    std::vector<Vec3> position;              ///< [m] relative to the frame's origin
    std::vector<float> width;                ///< [m] diameter
};

} // namespace mane
