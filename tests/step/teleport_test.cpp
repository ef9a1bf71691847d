/// Head and hair elsewhere at once, without a shock.

#include "step/live_hair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace mane;

namespace {

/// The hair as the head sees it.
struct InHead {
    std::vector<Vec3d> position, velocity;
    double kinetic_energy = 0; // [J] of the skeleton, relative to the head
};
InHead seen_from_head(const World& world, const Motion& motion) {
    const Frame& f = world.frame();
    std::vector<BonePose> bones(motion.bone_count());
    motion.evaluate(f.time, bones);
    const auto& [at, q, v, w] = bones[kHeadBone];
    InHead hair;
    for (std::size_t s = 0; s < f.position.size(); ++s) {
        const Vec3d arm = f.origin + Vec3d(f.position[s]) - at;
        const Vec3d relative = Vec3d(f.velocity[s]) - v - cross(w, arm);
        hair.position.push_back(q.conjugate().rotate(arm));
        hair.velocity.push_back(q.conjugate().rotate(relative));
        hair.kinetic_energy +=
            0.5 * double{world.groom().skeleton_mass[s]} * dot(relative, relative);
    }
    return hair;
}

double largest_difference(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        largest = std::max(largest, length(a[i] - b[i]));
    return largest;
}

const Pose kFar{{40, -3, 7}, {0, std::sin(1.1), 0, std::cos(1.1)}};

} // namespace

TEST_CASE("a jump of the head takes the hair along: the same shape and energy, seen from it") {
    auto motion = std::make_shared<DrivenBust>();
    World world = LiveHair::get().world(motion);
    advance_shaken(world, *motion, 9);
    const InHead before = seen_from_head(world, *motion);
    const Frame old = world.frame();
    REQUIRE(before.kinetic_energy > 1e-5); // in full swing

    motion->jump({kFar.position, normalized(Quatd{0.5, -0.3, 0.8, 0.1})});
    world.teleport();
    const InHead after = seen_from_head(world, *motion);
    // positions are floats of up to 1 m, velocities of a few m/s
    CHECK(largest_difference(before.position, after.position) < 4e-7);
    CHECK(largest_difference(before.velocity, after.velocity) < 2e-6);
    CHECK(after.kinetic_energy == doctest::Approx(before.kinetic_energy).epsilon(1e-5));
    CHECK(world.frame().radius == old.radius);
    CHECK(world.frame().radius_rate == old.radius_rate);
    CHECK(world.frame().index == old.index);
    CHECK(world.frame().time == old.time);
    CHECK(length(world.frame().origin - old.origin) > 30);
    for (const Contact& c : world.contacts())
        CHECK(c.kind != ContactKind::sliding); // looked for anew
}

TEST_CASE("a jump by nothing changes no bit") {
    auto plain_motion = std::make_shared<DrivenBust>(), motion = std::make_shared<DrivenBust>();
    World plain = LiveHair::get().world(plain_motion), world = LiveHair::get().world(motion);
    advance_shaken(plain, *plain_motion, 4);
    advance_shaken(world, *motion, 4);
    motion->jump({});
    world.teleport();
    CHECK(world.state_hash() == plain.state_hash());
    advance_shaken(plain, *plain_motion, 4);
    advance_shaken(world, *motion, 4);
    CHECK(world.state_hash() == plain.state_hash());
}

TEST_CASE("the run goes on calmly: hair at rest stays at rest, far away and turned about") {
    LiveHair calm = LiveHair::get();
    calm.desc.air.wind = {};
    calm.desc.air.gusts = 0;
    auto motion = std::make_shared<DrivenBust>();
    World world = calm.world(motion);
    advance(world, 24);
    const InHead before = seen_from_head(world, *motion);
    motion->jump(kFar); // about the vertical: gravity is as before
    world.teleport();
    double highest = 0, deepest = 0;
    for (int i = 0; i < 12; ++i) {
        world.advance();
        const InHead now = seen_from_head(world, *motion);
        highest = std::max(highest, now.kinetic_energy);
        deepest = std::max(deepest, largest_difference(before.position, now.position));
    }
    MESSAGE("kinetic energy " << before.kinetic_energy << " J before, at most " << highest
                              << " J after; moved by at most " << deepest * 1e6 << " µm");
    CHECK(highest < before.kinetic_energy + 1e-8);
    CHECK(deepest < 1e-3);
}

TEST_CASE("a head that jumped without its hair would have shaken it") {
    auto motion = std::make_shared<DrivenBust>();
    World world = LiveHair::get().world(motion);
    advance(world, 4);
    motion->jump({{0.02, 0, 0}, {}});
    world.advance(); // without teleport
    double fastest = 0;
    for (const Vec3d& v : seen_from_head(world, *motion).velocity)
        fastest = std::max(fastest, length(v));
    CHECK(fastest > 0.3);
}

TEST_CASE("a motion that is not finite is refused, and the hair stays where it was") {
    class Broken final : public Motion {
      public:
        bool broken = false;
        std::size_t bone_count() const override { return kBustBones; }
        void evaluate(double, std::span<BonePose> bones) const override {
            std::fill(bones.begin(), bones.end(), BonePose{});
            if (broken)
                bones[kHeadBone].position.x = std::numeric_limits<double>::infinity();
        }
    };
    auto motion = std::make_shared<Broken>();
    World world = LiveHair::get().world(motion);
    const std::uint64_t hash = world.state_hash();
    motion->broken = true;
    CHECK_THROWS_WITH_AS(world.teleport(),
                         "teleport: the head's motion is not finite at time 0.000000 s",
                         InputError);
    motion->broken = false;
    world.teleport();
    CHECK(world.state_hash() == hash);
}
