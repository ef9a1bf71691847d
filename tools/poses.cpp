#include "poses.h"

namespace mane::tool {

BodyPoses poses_at(const std::vector<Body>& bodies, double time) {
    BodyPoses poses;
    for (const Body& body : bodies) {
        poses.emplace_back(body.motion ? body.motion->bone_count() : 0);
        if (body.motion)
            body.motion->evaluate(time, poses.back());
    }
    return poses;
}

} // namespace mane::tool
