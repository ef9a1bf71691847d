#pragma once

#include "character/track.h"
#include "mane/vec.h"

namespace mane {

Quatd turn_about_x(double angle); // [rad], right-handed
Quatd turn_about_y(double angle);
Quatd turn_about_z(double angle);

// A rotation and how fast it turns [rad/s], world axes.
struct Turning {
    Quatd rotation;
    Vec3d angular_velocity;
};

// `inner` turning inside `outer`.
Turning turning_inside(const Turning& outer, const Turning& inner);

// The quaternion (x, y, z, w) of a track, normalised, and the exact angular velocity of that:
// interpolation leaves the unit sphere.
Turning turning_of(const TrackPoint<4>& point);

// Every quaternion or its opposite, the same rotation, on the side of the one before it, so that
// neighbours can be filtered and interpolated; the first on the side of `reference`.
void align_signs(std::vector<std::array<double, 4>>& rotations,
                 const std::array<double, 4>& reference);
void align_signs(std::vector<std::array<double, 4>>& rotations);

} // namespace mane
