#include "stored_frame.h"

#include "mane/cache.h"

namespace mane::tool {
namespace {

/// The middle of the points where the wisps leave the scalp, in the rest pose.
Vec3d middle_of_roots(const Groom& groom) {
    Vec3d sum;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        sum += Vec3d(groom.position[groom.first_section[w] + 1]);
    return sum / static_cast<double>(groom.wisp_count());
}

} // namespace

StoredFrame load_frame(const CacheReader& cache, std::size_t index) {
    const RunSetup& setup = cache.setup();
    StoredFrame stored;
    stored.frame = cache.frame(index);
    const BodyPoses poses = cache.poses(index);
    for (std::size_t b = 0; b < setup.bodies.size(); ++b)
        stored.bodies.push_back({skinned_vertices(setup.bodies[b], poses[b], stored.frame.origin),
                                 setup.bodies[b].mesh.triangles});
    stored.head_centre = middle_of_roots(setup.groom);
    if (!setup.bodies.empty() && setup.bodies[0].head_bone < poses[0].size()) {
        const BonePose& head = poses[0][setup.bodies[0].head_bone];
        stored.head_rotation = head.rotation;
        stored.head_centre = head.rotation.rotate(stored.head_centre) + head.position;
    }
    return stored;
}

SceneDesc scene_of(const CacheReader& cache, const std::string& file) {
    return parse_scene(cache.setup().scene, file + " (scene)", {});
}

} // namespace mane::tool
