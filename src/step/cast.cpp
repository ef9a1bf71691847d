#include "step/cast.h"

#include "character/skinning.h"

#include <utility>

namespace mane {

Cast::Cast(std::vector<Body> bodies) : bodies_(std::move(bodies)), posed_(bodies_.size()) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        posed_[b].vertices.resize(bodies_[b].mesh.vertices.size());
        posed_[b].velocities.resize(bodies_[b].mesh.vertices.size());
    }
}

std::span<const BonePose> Cast::bones_at(std::size_t b, double time) const {
    const Body& body = bodies_[b];
    bones_.assign(body.motion ? body.motion->bone_count() : 1, BonePose{});
    if (body.motion) {
        body.motion->evaluate(time, bones_);
    } else {
        std::size_t bones = 1; // a body at rest: every bone in its rest pose
        for (const auto& influences : body.skin.bones)
            for (std::uint16_t bone : influences)
                bones = std::max<std::size_t>(bones, bone + 1u);
        bones_.resize(bones);
    }
    return bones_;
}

void Cast::pose_body(std::size_t b, double time, const Vec3d& origin, Posed& out) const {
    pose_mesh(bodies_[b], bones_at(b, time), origin, out.vertices, out.velocities);
}

void Cast::pose(double time, const Vec3d& origin) {
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        pose_body(b, time, origin, posed_[b]);
}

Vec3d Cast::on_head(const Vec3d& rest, double time) const {
    const BonePose& head = bones_at(0, time)[bodies_[0].motion ? bodies_[0].head_bone : 0];
    return head.rotation.rotate(rest) + head.position;
}

Vec3d Cast::carried_like(std::size_t vertex, const Vec3d& rest, double time) const {
    const std::span<const BonePose> bones = bones_at(0, time);
    const Skin& skin = bodies_[0].skin;
    if (skin.bones.empty())
        return bones[0].rotation.rotate(rest) + bones[0].position;
    Vec3d sum;
    for (int i = 0; i < Skin::kInfluences; ++i) {
        const BonePose& bone = bones[skin.bones[vertex][i]];
        sum += (bone.rotation.rotate(rest) + bone.position) * double{skin.weights[vertex][i]};
    }
    return sum;
}

} // namespace mane
