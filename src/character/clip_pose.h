#pragma once

#include "mane/clip.h"

#include <array>
#include <vector>

namespace mane {

// A joint of a clip in the world, frame by frame.
struct JointTrajectory {
    std::vector<std::array<double, 3>> positions; // [clip's unit]
    std::vector<std::array<double, 4>> rotations; // x y z w
};

// The joint over the frames first … last, both included.
JointTrajectory joint_trajectory(const Clip& clip, std::size_t joint, std::size_t first,
                                 std::size_t last);

} // namespace mane
