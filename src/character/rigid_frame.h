#pragma once

#include "mane/vec.h"

namespace mane {

/// Where a rigid part of a body is.
struct RigidFrame {
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}; ///< unit, across each other
    Vec3d origin;                             ///< [m]

    Vec3d to_world(const Vec3d& p) const { return x * p.x + y * p.y + z * p.z + origin; }
    Vec3d to_local(const Vec3d& p) const { return direction_to_local(p - origin); }
    bool operator==(const RigidFrame&) const = default;
    Vec3d direction_to_local(const Vec3d& d) const { return {dot(x, d), dot(y, d), dot(z, d)}; }
};

} // namespace mane
