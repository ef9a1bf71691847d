#pragma once

#include "mane/body.h"
#include "mane/groom.h"

namespace mane {

/// A triangle's own axes, in which a root is kept: along its first edge, its normal, and their
/// cross product.
struct TriangleFrame {
    Vec3d origin; ///< [m] the root on the triangle
    Vec3d edge, normal, side;

    Vec3d inward(const Vec3d& direction) const {
        return {dot(direction, edge), dot(direction, normal), dot(direction, side)};
    }
};
TriangleFrame triangle_frame(const Mesh& mesh, std::uint32_t triangle, const Vec3& barycentric);

} // namespace mane
