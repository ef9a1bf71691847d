#include "character/skinning.h"

#include "base/random.h"
#include "mane/character.h"
#include "mane/error.h"

#include <doctest/doctest.h>

using namespace mane;

namespace {

// A body of loose vertices with up to four influences each.
Body random_body(std::size_t vertices, std::size_t bones) {
    Body body;
    const Random random(3, 1);
    for (std::size_t v = 0; v < vertices; ++v) {
        const auto at = [&](std::uint64_t k) { return random.between(32 * v + k, -2, 2); };
        body.mesh.vertices.emplace_back(at(0), at(1), at(2));
        std::array<std::uint16_t, 4> bone{};
        std::array<float, 4> weight{};
        float sum = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            bone[k] = static_cast<std::uint16_t>(random.bits(32 * v + 8 + k) % bones);
            weight[k] = random.unit(32 * v + 16 + k) *
                        (random.bits(32 * v + 24 + k) % 2 || k == 0 ? 1.0f : 0.0f);
            sum += weight[k];
        }
        for (float& w : weight)
            w /= sum;
        body.skin.bones.push_back(bone);
        body.skin.weights.push_back(weight);
    }
    return body;
}

std::vector<BonePose> random_bones(std::size_t count) {
    std::vector<BonePose> bones;
    const Random random(4, 2);
    for (std::size_t b = 0; b < count; ++b) {
        const auto at = [&](std::uint64_t k) { return double{random.between(32 * b + k, -3, 3)}; };
        bones.push_back({{at(0), at(1), at(2)},
                         normalized(Quatd{at(3), at(4), at(5), at(6)}),
                         {at(7), at(8), at(9)},
                         {at(10), at(11), at(12)}});
    }
    return bones;
}

} // namespace

TEST_CASE("skinning equals the weighted sum of each bone's own motion") {
    const Body body = random_body(500, 7);
    const std::vector<BonePose> bones = random_bones(7);
    const Vec3d origin(1, -2, 0.5);
    std::vector<Vec3> position(500), velocity(500);
    pose_mesh(body, bones, origin, position, velocity);
    for (std::size_t v = 0; v < 500; ++v) {
        Vec3d x = -origin, speed;
        for (std::size_t k = 0; k < 4; ++k) {
            const BonePose& bone = bones[body.skin.bones[v][k]];
            const double weight = body.skin.weights[v][k];
            const Vec3d arm = bone.rotation.rotate(Vec3d(body.mesh.vertices[v]));
            x += (bone.position + arm) * weight;
            speed += (bone.velocity + cross(bone.angular_velocity, arm)) * weight;
        }
        // magnitudes up to 10 and 30 in float; weights add up to one but for 2e-7 of the
        // origin's 2.3 m
        CHECK(length(Vec3d(position[v]) - x) < 2e-6);
        CHECK(length(Vec3d(velocity[v]) - speed) < 4e-6);
    }
}

TEST_CASE(
    "without a skin all vertices follow bone 0; far from the world's origin nothing is lost") {
    Body body = random_body(50, 3);
    body.skin = {};
    std::vector<BonePose> bones = random_bones(3);
    std::vector<Vec3> near(50), far(50), velocity(50);
    pose_mesh(body, bones, bones[0].position, near, velocity);
    const Vec3d away(4096, -1024, 2048); // exact in double beside metres
    bones[0].position += away;
    pose_mesh(body, bones, bones[0].position, far, velocity);
    for (std::size_t v = 0; v < 50; ++v) {
        CHECK(near[v] == far[v]);
        CHECK(length(Vec3d(near[v]) - bones[0].rotation.rotate(Vec3d(body.mesh.vertices[v]))) <
              1e-6);
    }
}

TEST_CASE("too many bones are refused") {
    const Body body = random_body(1, 1);
    std::vector<Vec3> one(1), rate(1);
    CHECK_THROWS_AS(pose_mesh(body, random_bones(300), {}, one, rate), InputError);
}
