#include "host/handle.h"

#include <cmath>
#include <string>

namespace mane {
namespace {

Vec3 vec3(const float* x) {
    return {x[0], x[1], x[2]};
}

Mesh mesh_of(const mane_body& body) {
    given(body.vertices, "vertices");
    given(body.triangles, "triangles");
    Mesh mesh;
    for (std::size_t v = 0; v < body.vertex_count; ++v)
        mesh.vertices.push_back(vec3(body.vertices + 3 * v));
    for (std::size_t t = 0; t < body.triangle_count; ++t) {
        const std::uint32_t* corner = body.triangles + 3 * t;
        for (int c = 0; c < 3; ++c)
            if (corner[c] >= body.vertex_count)
                throw InputError("triangle " + std::to_string(t) + " names vertex " +
                                 std::to_string(corner[c]) + "; expected one of " +
                                 std::to_string(body.vertex_count));
        mesh.triangles.push_back({corner[0], corner[1], corner[2]});
    }
    for (const Vec3& v : mesh.vertices)
        if (!std::isfinite(v.x + v.y + v.z))
            throw InputError("a vertex that is not finite");
    if (mesh.triangles.empty())
        throw InputError("a body of no triangles");
    return mesh;
}

Skin skin_of(const mane_body& body, std::size_t bones) {
    Skin skin;
    if (!body.skin_bones && !body.skin_weights)
        return skin;
    given(body.skin_bones, "skin_bones");
    given(body.skin_weights, "skin_weights");
    for (std::size_t v = 0; v < body.vertex_count; ++v) {
        std::array<std::uint16_t, Skin::kInfluences> bone{};
        std::array<float, Skin::kInfluences> weight{};
        for (std::size_t i = 0; i < bone.size(); ++i) {
            bone[i] = body.skin_bones[bone.size() * v + i];
            weight[i] = body.skin_weights[bone.size() * v + i];
            if (bone[i] >= bones || !std::isfinite(weight[i]))
                throw InputError("vertex " + std::to_string(v) + " follows bone " +
                                 std::to_string(bone[i]) + "; expected one of " +
                                 std::to_string(bones) + ", by a finite weight");
        }
        skin.bones.push_back(bone);
        skin.weights.push_back(weight);
    }
    return skin;
}

/// The middle of what follows a bone: a point of it that goes a smooth way.
Vec3d middle_of(const Mesh& mesh, const Skin& skin, std::size_t bone) {
    Vec3d sum;
    double weights = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        double weight = skin.bones.empty() && bone == 0 ? 1 : 0;
        for (std::size_t i = 0; !skin.bones.empty() && i < Skin::kInfluences; ++i)
            if (skin.bones[v][i] == bone)
                weight += double{skin.weights[v][i]};
        sum += Vec3d(mesh.vertices[v]) * weight;
        weights += weight;
    }
    return weights > 0 ? sum / weights : Vec3d();
}

Body body_of(const mane_body& known, std::shared_ptr<DrivenMotion>& motion) {
    const std::size_t bone_count = std::max<std::size_t>(known.bone_count, 1);
    Body body;
    body.name = known.name ? known.name : "body";
    body.mesh = mesh_of(known);
    body.skin = skin_of(known, bone_count);
    body.head_bone = known.head_bone;
    body.worn = known.worn != 0;
    if (known.head_bone >= bone_count)
        throw InputError("head_bone is " + std::to_string(known.head_bone) + "; expected one of " +
                         std::to_string(bone_count));
    std::vector<DrivenMotion::Bone> bones(bone_count);
    for (std::size_t b = 0; b < bone_count; ++b)
        bones[b].pivot = middle_of(body.mesh, body.skin, b);
    motion = std::make_shared<DrivenMotion>(bones);
    body.motion = motion;
    return body;
}

/// The designs of hair that is given as arrays, without their parameters.
std::vector<WispDesign> designs_of(const mane_hair& hair, std::uint32_t points,
                                   std::uint32_t strand_count) {
    given(hair.first_section, "first_section");
    given(hair.position, "position");
    given(hair.radius, "radius");
    given(hair.triangle, "triangle");
    given(hair.barycentric, "barycentric");
    given(hair.first_axis, "first_axis");
    std::vector<WispDesign> designs(hair.wisp_count);
    for (std::size_t w = 0; w < hair.wisp_count; ++w) {
        const std::size_t first = hair.first_section[w], end = hair.first_section[w + 1];
        if (first > end)
            throw InputError("wisp " + std::to_string(w) +
                             ": first_section falls; expected it to rise");
        WispDesign& wisp = designs[w];
        wisp.triangle = hair.triangle[w];
        wisp.barycentric = vec3(hair.barycentric + 3 * w);
        wisp.first_axis = vec3(hair.first_axis + 3 * w);
        for (std::size_t s = first; s < end; ++s)
            wisp.position.push_back(vec3(hair.position + 3 * s));
        wisp.radius.assign(hair.radius + points * first, hair.radius + points * end);
        wisp.strands = hair.strands
                           ? hair.strands[w]
                           : static_cast<std::uint32_t>((w + 1) * strand_count / hair.wisp_count -
                                                        w * strand_count / hair.wisp_count);
    }
    return designs;
}

/// Hair of these designs with the parameters of a scene, in balance as at first.
struct GrowDesigns {
    std::vector<WispDesign> designs;
    Mesh wearer;
    Vec3 gravity;
    bool share_strands; ///< "strands.count", evenly

    Groom operator()(const SceneDesc& scene) const {
        std::vector<WispDesign> now = designs;
        for (std::size_t w = 0; w < now.size(); ++w) {
            now[w].skeleton = scene.hair.skeleton;
            now[w].envelope = scene.hair.envelope;
            const std::uint64_t count = scene.hair.strands.count;
            if (share_strands)
                now[w].strands = static_cast<std::uint32_t>((w + 1) * count / now.size() -
                                                            w * count / now.size());
        }
        return make_groom(now, wearer, gravity);
    }
};

SceneDesc scene_of(const mane_setting* settings, std::size_t count) {
    if (count > 0)
        given(settings, "settings");
    SceneDesc scene;
    for (std::size_t i = 0; i < count; ++i)
        apply(scene, settings[i]);
    check_scene(scene, "settings");
    return scene;
}

std::unique_ptr<mane_world> create(std::span<const mane_body> bodies, const mane_hair& hair,
                                   const SceneDesc& scene, const mane_options& options) {
    if (bodies.empty())
        throw InputError("no bodies; expected at least the one that wears the hair");
    std::vector<Body> made;
    std::vector<std::shared_ptr<DrivenMotion>> motions(bodies.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        try {
            made.push_back(body_of(bodies[b], motions[b]));
        } catch (const InputError& error) {
            throw InputError("body " + std::to_string(b) + ": " + error.what());
        }
    }
    const GrowDesigns grow{designs_of(hair, scene.hair.envelope.points, scene.hair.strands.count),
                           made[0].mesh, scene.simulation.gravity, hair.strands == nullptr};
    const RunOptions run = run_options(options);
    LiveScene live(scene, grow(scene), std::move(made), grow, options.start_time, run);
    return std::make_unique<mane_world>(std::move(live), nullptr, std::move(motions), run);
}

} // namespace
} // namespace mane

using namespace mane;

mane_result mane_create(const mane_body* bodies, size_t body_count, const mane_hair* hair,
                        const mane_setting* settings, size_t setting_count,
                        const mane_options* options, mane_world** world) {
    return guarded([&] {
        given(world, "world");
        if (body_count > 0)
            given(bodies, "bodies");
        std::vector<mane_body> known; // callers of an older version have shorter ones
        const char* at = reinterpret_cast<const char*>(bodies);
        for (std::size_t b = 0; b < body_count; ++b, at += bodies->size)
            known.push_back(known_part(*reinterpret_cast<const mane_body*>(at)));
        *world = create(known, known_part(given(hair, "hair")), scene_of(settings, setting_count),
                        known_options(options))
                     .release();
    });
}

void mane_destroy(mane_world* world) {
    delete world;
}
