#include "step/cast.h"

#include "character/skinning.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mane {
namespace {

/// Bones that a body needs: its motion's, or, at rest, those that its skin names.
std::size_t bone_count(const Body& body) {
    if (body.motion)
        return body.motion->bone_count();
    std::size_t bones = 1;
    for (const auto& influences : body.skin.bones)
        for (std::uint16_t bone : influences)
            bones = std::max<std::size_t>(bones, bone + 1u);
    return bones;
}

/// The bones that most of the vertices follow, at most as many as a surface takes frames.
std::vector<std::uint32_t> main_bones(const Body& body) {
    std::vector<double> weight(bone_count(body), 0);
    for (std::size_t v = 0; v < body.skin.bones.size(); ++v)
        for (std::size_t k = 0; k < Skin::kInfluences; ++k)
            weight[body.skin.bones[v][k]] += double{body.skin.weights[v][k]};
    std::vector<std::uint32_t> bones(weight.size());
    std::iota(bones.begin(), bones.end(), 0u);
    std::stable_sort(bones.begin(), bones.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return weight[a] > weight[b]; });
    bones.resize(std::min(bones.size(), Drift::kFrames));
    return bones;
}

RigidFrame frame_of(const BonePose& bone, const Vec3d& origin) {
    return {bone.rotation.rotate({1, 0, 0}), bone.rotation.rotate({0, 1, 0}),
            bone.rotation.rotate({0, 0, 1}), bone.position - origin};
}

} // namespace

Cast::Cast(std::vector<Body> bodies, const std::string& instruction_set)
    : bodies_(std::move(bodies)), posed_(bodies_.size()) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        posed_[b].vertices.resize(bodies_[b].mesh.vertices.size());
        posed_[b].velocities.resize(bodies_[b].mesh.vertices.size());
        posed_[b].main_bones = main_bones(bodies_[b]);
        posed_[b].frames.resize(posed_[b].main_bones.size());
        surfaces_.push_back(std::make_unique<Surface>(bodies_[b].mesh, instruction_set));
    }
}

std::size_t Cast::bones(std::size_t b) const {
    return bone_count(bodies_[b]);
}

std::span<const BonePose> Cast::bones_at(std::size_t b, double time) const {
    bones_.assign(bone_count(bodies_[b]), BonePose{});
    if (bodies_[b].motion)
        bodies_[b].motion->evaluate(time, bones_);
    return bones_;
}

void Cast::pose(std::size_t b, double time, const Vec3d& origin) {
    const std::span<const BonePose> bones = bones_at(b, time);
    Posed& posed = posed_[b];
    pose_mesh(bodies_[b], bones, origin, posed.vertices, posed.velocities);
    for (std::size_t f = 0; f < posed.frames.size(); ++f)
        posed.frames[f] = frame_of(bones[posed.main_bones[f]], origin);
}

void Cast::begin(double time, const Vec3d& origin) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        pose(b, time, origin);
        surfaces_[b]->reset(posed_[b].vertices, posed_[b].frames);
    }
}

void Cast::advance(double time, double seconds, const Vec3d& origin) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
        pose(b, time, origin);
        surfaces_[b]->advance(posed_[b].vertices, seconds, posed_[b].frames);
    }
}

std::vector<ContactBody> Cast::contact_bodies() const {
    std::vector<ContactBody> list;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
        list.push_back({surfaces_[b].get(), bodies_[b].worn});
    return list;
}

std::vector<std::string> Cast::names() const {
    std::vector<std::string> list;
    for (const Body& body : bodies_)
        list.push_back(body.name);
    return list;
}

Vec3d Cast::on_head(const Vec3d& rest, double time) const {
    const BonePose pose = head(time);
    return pose.rotation.rotate(rest) + pose.position;
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
