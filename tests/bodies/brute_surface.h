#pragma once

#include "character/closing.h"
#include "mane/body.h"

#include <vector>

/// The slow, obvious twin of PosedSurface.
namespace mane::test {

/// The vertices of a closed mesh: the mesh's own and the caps' centres.
std::vector<Vec3> closed_vertices(const ClosedMesh& closed, const std::vector<Vec3>& vertices);

/// Generalised winding number (Jacobson et al. 2013): the solid angles of all triangles over 4π.
/// Defined for any triangles.
double winding_number(const ClosedMesh& closed, const std::vector<Vec3>& vertices, const Vec3d& p);

/// Distance from `p` to one triangle, by projection on the plane and on each edge.
double distance_to_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

} // namespace mane::test
