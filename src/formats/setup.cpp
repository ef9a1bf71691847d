#include "mane/setup.h"

#include "base/functions.h"
#include "mane/error.h"
#include "mane/import.h"
#include "mane/scene.h"

#include <algorithm>

namespace mane {
namespace {

class Follower : public Motion {
  public:
    Follower(std::shared_ptr<const Motion> leader, std::uint32_t bone)
        : leader_(std::move(leader)), bone_(bone) {}
    std::size_t bone_count() const override { return 1; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        std::vector<BonePose> all(leader_->bone_count());
        leader_->evaluate(time, all);
        bones[0] = all[bone_];
    }

  private:
    std::shared_ptr<const Motion> leader_;
    std::uint32_t bone_;
};

std::shared_ptr<const Motion> moving(const MotionDesc& desc) {
    if (!desc.clip.empty())
        return clip_motion(read_bvh(desc.clip), desc.drive);
    constexpr double kDegree = kPi / 180;
    return desc.shake > 0 ? shake_motion(desc.shake * kDegree, desc.shake_rate) : builtin_motion();
}

Mesh read_mesh(const std::string& file, double unit, std::vector<std::string>& warnings) {
    MeshReport report;
    Mesh mesh = read_obj(file, unit, &report);
    if (!report.clean())
        warnings.push_back(file + ": " + report.warning());
    return mesh;
}

/// A mesh of the user's follows the head as one piece.
Body read_wearer(const CharacterDesc& desc, std::vector<std::string>& warnings) {
    Body body;
    body.name = desc.mesh;
    body.mesh = read_mesh(desc.mesh, desc.unit, warnings);
    for (Vec3& v : body.mesh.vertices)
        v += desc.offset;
    body.skin.bones.assign(body.mesh.vertices.size(), {kHeadBone, 0, 0, 0});
    body.skin.weights.assign(body.mesh.vertices.size(), {1, 0, 0, 0});
    body.head_bone = kHeadBone;
    return body;
}

std::vector<std::uint32_t> find_scalp(const CharacterDesc& desc, const Body& wearer) {
    if (desc.scalp_radius == 0) {
        if (desc.mesh.empty())
            return bust_scalp(wearer);
        throw InputError(
            desc.mesh +
            ": a mesh of your own needs character.scalp_centre and character.scalp_radius");
    }
    std::vector<std::uint32_t> scalp;
    for (std::uint32_t t = 0; t < wearer.mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = wearer.mesh.triangles[t];
        const auto& v = wearer.mesh.vertices;
        if (length((v[a] + v[b] + v[c]) / 3.f - desc.scalp_centre) <= desc.scalp_radius)
            scalp.push_back(t);
    }
    if (scalp.empty())
        throw InputError(
            "character.scalp_centre and character.scalp_radius hold no triangle of the character");
    return scalp;
}

/// The settings of some wisps.
void apply_overrides(const SceneDesc& scene, std::span<WispDesign> designs) {
    for (const WispOverride& o : scene.overrides)
        for (const std::uint32_t wisp : o.wisps) {
            if (wisp >= designs.size())
                throw InputError("override.wisps: found wisp " + std::to_string(wisp) +
                                 ", expected one under " + std::to_string(designs.size()));
            const HairDesc own = scene_of_wisp(scene, wisp).hair;
            designs[wisp].skeleton = own.skeleton;
            designs[wisp].envelope = own.envelope;
        }
}

/// Grows the hair of scene after scene on one wearer. What is laid is kept: most of them differ in
/// springs alone.
class Grower {
  public:
    Grower(const Body& wearer, const Vec3& gravity) : wearer_(wearer), gravity_(gravity) {}

    Groom operator()(const SceneDesc& scene) {
        if (laid_.empty() || !laid_alike(scene)) {
            laid_ = lay_style(scene.hair, wearer_, find_scalp(scene.character, wearer_),
                              scene.simulation.seed);
            laid_for_ = scene;
        }
        std::vector<WispDesign> designs = laid_;
        give_springs(designs, scene.hair);
        apply_overrides(scene, designs);
        return make_groom(designs, wearer_.mesh, gravity_);
    }

  private:
    bool laid_alike(const SceneDesc& scene) const {
        const auto fields = fields_of<SceneDesc>();
        return std::all_of(fields.begin(), fields.end(), [&](const Field& f) {
            const bool lays = f.section == "style" || f.section == "character" ||
                              f.key() == "strands.count" || f.key() == "envelope.points" ||
                              f.key() == "simulation.seed";
            return !lays || f.get(scene) == f.get(laid_for_);
        });
    }

    Body wearer_;
    Vec3 gravity_;
    std::vector<WispDesign> laid_;
    SceneDesc laid_for_;
};

Body make_obstacle(const ObstacleDesc& desc, const Body& wearer,
                   std::vector<std::string>& warnings) {
    Body body;
    body.name = desc.name;
    body.mesh = desc.shape == ObstacleShape::mesh ? read_mesh(desc.mesh, desc.unit, warnings)
                                                  : obstacle_mesh(desc);
    body.worn = desc.worn;
    const std::vector<MotionKey> keys = obstacle_keys(desc);
    if (!desc.worn) {
        if (!keys.empty())
            body.motion = keyframed_motion(keys);
        return body;
    }
    if (!keys.empty())
        for (Vec3& v : body.mesh.vertices)
            v = Vec3(keys[0].rotation.rotate(Vec3d(v)) + keys[0].position);
    if (wearer.motion)
        body.motion = following_motion(wearer.motion, wearer.head_bone);
    return body;
}

} // namespace

std::shared_ptr<const Motion> following_motion(std::shared_ptr<const Motion> leader,
                                               std::uint32_t bone) {
    return std::make_shared<Follower>(std::move(leader), bone);
}

std::shared_ptr<const Motion> make_motion(const MotionDesc& desc) {
    if (desc.still)
        return nullptr;
    std::shared_ptr<const Motion> motion = moving(desc);
    return desc.freeze > 0 ? frozen_motion(std::move(motion), desc.freeze) : motion;
}

Groom grow_hair(const SceneDesc& scene, const Body& wearer, const Vec3& gravity) {
    return Grower(wearer, gravity)(scene);
}

RunSetup prepare(const SceneDesc& scene) {
    return prepare(scene, make_motion(scene.motion));
}

RunSetup prepare(const SceneDesc& scene, std::shared_ptr<const Motion> motion) {
    RunSetup setup;
    setup.scene = write_scene(scene);
    Body wearer =
        scene.character.mesh.empty() ? make_bust() : read_wearer(scene.character, setup.warnings);
    wearer.motion = std::move(motion);
    setup.groom = grow_hair(scene, wearer, scene.simulation.gravity);
    setup.bodies.push_back(wearer);
    for (const ObstacleDesc& obstacle : scene.obstacles)
        setup.bodies.push_back(make_obstacle(obstacle, wearer, setup.warnings));
    return setup;
}

LiveScene make_live(const SceneDesc& scene, const RunSetup& setup, double start_time,
                    const RunOptions& options) {
    return LiveScene(scene, setup.groom, setup.bodies,
                     Grower(setup.bodies[0], scene.simulation.gravity), start_time, options);
}

} // namespace mane
