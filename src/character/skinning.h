#pragma once

#include "mane/body.h"

#include <span>

namespace mane {

// Linear blend skinning of all vertices (§4.2): positions [m] relative to `origin` and velocities
// [m/s] in world axes, both of the size of the mesh. Computed in double, so that a pose far from
// the world's origin is as exact as one at it. Allocates nothing.
void pose_mesh(const Body& body, std::span<const BonePose> bones, const Vec3d& origin,
               std::span<Vec3> positions, std::span<Vec3> velocities);

} // namespace mane
