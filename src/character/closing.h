#pragma once

#include "mane/body.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mane {

/// A mesh's triangles made closed, so that "inside" is defined everywhere: the corners join where
/// vertices coincide, and every border loop is filled by a fan around a new vertex at the loop's
/// mean.
struct ClosedMesh {
    /// Corners: indices under `vertex_count` are the mesh's own, those from there on are caps'
    /// centres.
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t own_triangles =
        0; ///< the first ones are the mesh's, in its order; the rest are caps
    std::size_t vertex_count = 0; ///< of the mesh
    std::vector<std::vector<std::uint32_t>>
        cap_loops;                      ///< per cap: the border vertices whose mean is its centre
    std::size_t open_edges = 0;         ///< used by one triangle only
    std::size_t non_manifold_edges = 0; ///< used by more than two triangles
};

/// Closes `mesh`. The borders are found as a chain: on every edge the triangles that run along it
/// one way are counted against those that run the other way. What is left over is a sum of loops
/// whatever the mesh is (open, non-manifold, badly oriented), and the caps take it to zero; so
/// winding numbers are whole numbers everywhere, parts may overlap, and no case needs a repair.
/// Triangles that vanish by joining vertices stay (they count for nothing).
ClosedMesh close_borders(const Mesh& mesh);

} // namespace mane
