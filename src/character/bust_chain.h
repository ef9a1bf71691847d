#pragma once

#include "character/rotation.h"
#include "mane/character.h"

#include <array>
#include <span>

namespace mane {

// Where a point is and how it moves.
struct PointMotion {
    Vec3d position; // [m]
    Vec3d velocity; // [m/s]
};

using BustTurning = std::array<Turning, kBustBones>; // chest, neck, head, in world axes

// The bone that turns so and carries the rest point `rest` where `point` is.
BonePose bone_through(const Vec3d& rest, const PointMotion& point, const Turning& turning);

// Poses of the three bones, joined at the neck's and the head's joints, from the motion of the
// chest's joint …
void pose_from_chest(const BustJoints& joints, const PointMotion& chest, const BustTurning& turning,
                     std::span<BonePose> bones);
// … or of the head's.
void pose_from_head(const BustJoints& joints, const PointMotion& head, const BustTurning& turning,
                    std::span<BonePose> bones);

} // namespace mane
