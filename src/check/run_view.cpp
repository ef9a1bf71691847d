#include "check/run_view.h"

#include "mane/error.h"
#include "mane/scene.h"

#include <algorithm>

namespace mane::judge {
namespace {

constexpr double kAtRest = 1e-6; // [m], and in the numbers of a unit quaternion

bool same_pose(const BonePose& a, const BonePose& b) {
    // q and −q are the same rotation.
    return length(a.position - b.position) <= kAtRest &&
           1 - std::fabs(dot(a.rotation, b.rotation)) <= kAtRest * kAtRest;
}

bool same_poses(const BodyPoses& a, const BodyPoses& b) {
    return std::ranges::equal(a, b, [](const auto& bones, const auto& others) {
        return std::ranges::equal(bones, others, same_pose);
    });
}

} // namespace

RunView view_run(const CacheReader& run, const CheckOptions& options) {
    const std::size_t frames = run.frame_count();
    if (frames == 0)
        throw InputError("check: the cache holds no frames");
    const SceneDesc scene = parse_scene(run.setup().scene, "scene in the cache", {});
    RunView view{run.setup().groom,
                 run.setup().bodies,
                 scene.simulation,
                 scene.hair.strands,
                 scene.check,
                 options,
                 {},
                 {},
                 run.statistics(),
                 run.damage()};
    for (std::size_t i = 0; i < frames; ++i) {
        view.time.push_back(run.frame(i).time);
        if (i > 0 && !(view.time[i] > view.time[i - 1]))
            throw InputError("check: the time of frame " + std::to_string(i) +
                             " is not after that of the frame before");
    }
    const BodyPoses last = run.poses(frames - 1);
    std::size_t still = frames - 1;
    while (still > 0 && same_poses(run.poses(still - 1), last))
        --still;
    if (still + 1 < frames)
        view.stop = view.time[still];
    return view;
}

} // namespace mane::judge
