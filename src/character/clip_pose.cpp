#include "character/clip_pose.h"

#include "base/functions.h"
#include "character/rotation.h"

#include <algorithm>

namespace mane {
namespace {

struct Placement {
    Vec3d position;
    Quatd rotation;
};

// The joint inside its parent, from the numbers of one frame.
Placement local_placement(const Clip::Joint& joint, const double* frame) {
    const double degree = kPi / 180;
    Placement local{joint.offset, {}};
    for (std::size_t c = 0; c < joint.channels.size(); ++c) {
        const double x = frame[joint.first_channel + c];
        switch (joint.channels[c]) {
        case Clip::Channel::x_position:
            local.position.x = x;
            break;
        case Clip::Channel::y_position:
            local.position.y = x;
            break;
        case Clip::Channel::z_position:
            local.position.z = x;
            break;
        case Clip::Channel::x_rotation:
            local.rotation = local.rotation * turn_about_x(x * degree);
            break;
        case Clip::Channel::y_rotation:
            local.rotation = local.rotation * turn_about_y(x * degree);
            break;
        case Clip::Channel::z_rotation:
            local.rotation = local.rotation * turn_about_z(x * degree);
            break;
        }
    }
    return local;
}

std::vector<std::size_t> path_from_root(const Clip& clip, std::size_t joint) {
    std::vector<std::size_t> path{joint};
    while (clip.joints[path.back()].parent >= 0)
        path.push_back(static_cast<std::size_t>(clip.joints[path.back()].parent));
    std::reverse(path.begin(), path.end());
    return path;
}

} // namespace

JointTrajectory joint_trajectory(const Clip& clip, std::size_t joint, std::size_t first,
                                 std::size_t last) {
    const std::vector<std::size_t> path = path_from_root(clip, joint);
    JointTrajectory trajectory;
    for (std::size_t f = first; f <= last; ++f) {
        Placement world;
        for (std::size_t j : path) {
            const Placement local = local_placement(clip.joints[j], clip.frame(f));
            world.position += world.rotation.rotate(local.position);
            world.rotation = world.rotation * local.rotation;
        }
        const auto& [p, q] = world;
        trajectory.positions.push_back({p.x, p.y, p.z});
        trajectory.rotations.push_back({q.x, q.y, q.z, q.w});
    }
    return trajectory;
}

} // namespace mane
