#pragma once

#include "mane/vec.h"

namespace mane::judge {

/// The point of triangle a, b, c that is nearest to `p`.
Vec3d nearest_in_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// Whether the straight line from `p` to `q` passes through the triangle.
bool line_meets_triangle(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b,
                         const Vec3d& c);

/// How often, with sign, the vertical line through `p` passes through the triangle: 1 where the
/// triangle faces up, −1 where it faces down. Over the triangles round a vertex or along an edge
/// the answers fit together, whatever the rounding.
int vertical_passes(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

/// The height at which the vertical line through `p` passes through the triangle's plane.
double height_over(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c);

} // namespace mane::judge
