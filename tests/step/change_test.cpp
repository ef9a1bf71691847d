/// Parameters that change while a world runs (M46). Every field of the table is tried in
/// tests/formats; here is what a change promises.

#include "step/live_hair.h"

#include <doctest/doctest.h>

#include <cstring>
#include <limits>
#include <string>

using namespace mane;

namespace {

World shaking_world() {
    return LiveHair::get().world(shake_motion(0.5, 2));
}

std::string refusal(World& world, const SimulationDesc& desc) {
    try {
        world.change(desc);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("the same parameters again change no bit") {
    World plain = shaking_world(), changed = shaking_world();
    for (int i = 0; i < 12; ++i) {
        changed.change(changed.desc());
        plain.advance();
        changed.advance();
        REQUIRE(plain.state_hash() == changed.state_hash());
    }
    CHECK(plain.contacts().size() > 20);
}

TEST_CASE("changed there and back at one frame changes no bit") {
    World plain = shaking_world(), changed = shaking_world();
    advance(plain, 5);
    advance(changed, 5);
    SimulationDesc other = changed.desc();
    other.gravity = {3, 2, 1};
    other.air.gusts = 2;
    other.wisps.friction = 99;
    other.wisps.parallel_angle = 50;
    other.character.threshold = 0.01f;
    changed.change(other);
    changed.change(plain.desc());
    advance(plain, 6);
    advance(changed, 6);
    CHECK(plain.state_hash() == changed.state_hash());
}

TEST_CASE("other rates keep time: frames follow each other as before") {
    World world = shaking_world();
    advance(world, 3);
    SimulationDesc desc = world.desc();
    desc.schedule.integration_rate = 1500;
    desc.schedule.character_rate = 240;
    desc.schedule.wisp_rate = 60;
    world.change(desc);
    const Statistics before = world.statistics();
    advance(world, 2);
    CHECK(world.frame().time == doctest::Approx(5.0 / 24).epsilon(1e-12));
    CHECK(world.frame().index == 5);
    const Statistics& now = world.statistics();
    CHECK(now.steps - before.steps == 2 * 63); // ⌈1500/24⌉
    CHECK(now.character_detections - before.character_detections == 2 * 10);
    CHECK(now.wisp_detections - before.wisp_detections == 2 * 3);

    desc.schedule.frame_rate = 60; // shorter frames from now on
    world.change(desc);
    CHECK(world.next_time() == doctest::Approx(5.0 / 24 + 1.0 / 60).epsilon(1e-12));
    advance(world, 4);
    CHECK(world.frame().time == doctest::Approx(5.0 / 24 + 4.0 / 60).epsilon(1e-12));
}

TEST_CASE("rates that change before the first step are those of a world made with them") {
    SimulationDesc desc = LiveHair::get().desc;
    desc.schedule.integration_rate = 1300;
    desc.schedule.character_rate = 100;
    Body bust = LiveHair::get().bust;
    bust.motion = shake_motion(0.5, 2);
    World made(desc, LiveHair::get().groom, {bust}), changed = shaking_world();
    changed.change(desc);
    CHECK(made.state_hash() == changed.state_hash());
    advance(made, 5);
    advance(changed, 5);
    CHECK(made.state_hash() == changed.state_hash());
}

TEST_CASE("bad values are refused by name, and the world goes on as if they had not been asked") {
    World plain = shaking_world(), asked = shaking_world();
    advance(plain, 4);
    advance(asked, 4);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto refused = [&](auto&& change) {
        SimulationDesc desc = asked.desc();
        change(desc);
        return refusal(asked, desc);
    };
    CHECK(refused([&](auto& d) { d.gravity.y = nan; }) ==
          "simulation.gravity: found nan, expected three finite numbers");
    CHECK(refused([&](auto& d) { d.air.drag = -1; }) ==
          "air.drag: found -1.000000, expected a number of at least 0.000000");
    CHECK(refused([&](auto& d) { d.wisps.parallel_angle = 120; }) ==
          "wisps.parallel_angle: found 120.000000, expected 0 to 90 degrees");
    CHECK(refused([&](auto& d) { d.wisps.hysteresis = 0.5f; }) ==
          "wisps.hysteresis: found 0.500000, expected a number of at least 1.000000");
    CHECK(refused([&](auto& d) { d.character.push_out = 0.1f; }) ==
          "character.push_out: found 0.100000, expected at most character.threshold = 0.004000");
    CHECK(refused([&](auto& d) {
              d.schedule.character_rate = 0;
          }).starts_with("schedule.character_rate is 0"));
    CHECK(refused([&](auto& d) { d.schedule.integration_rate = 100; }).find("unstable") !=
          std::string::npos);
    CHECK(refused([&](auto& d) { d.air.drag = 5000; }).find("mostly by air.drag") !=
          std::string::npos);
    CHECK(refused([&](auto& d) { d.seed = 2; }) ==
          "simulation.seed: found 2.000000, expected 1: it is fixed while a world runs");
    CHECK(std::memcmp(&plain.desc(), &asked.desc(), sizeof(SimulationDesc)) == 0);
    advance(plain, 4);
    advance(asked, 4);
    CHECK(plain.state_hash() == asked.state_hash());
}

TEST_CASE("wisps that no longer meet, and meet again, have no contact of the past") {
    // The hysteresis of a contact (M23) is of the detection before, not of one long ago.
    World world = shaking_world();
    advance(world, 6);
    const std::size_t before = world.contacts().size();
    SimulationDesc desc = world.desc();
    const auto change_mode = [&](WispContactMode mode) {
        desc.wisps.mode = mode;
        world.change(desc);
    };
    const auto of_wisps = [&] {
        std::size_t count = 0;
        for (const Contact& c : world.contacts())
            count += c.kind != ContactKind::sliding;
        return count;
    };
    change_mode(WispContactMode::off);
    CHECK(of_wisps() == 0);
    change_mode(WispContactMode::anisotropic); // nothing has happened meanwhile
    CHECK(world.contacts().size() == before);
    change_mode(WispContactMode::off);
    world.advance();
    change_mode(WispContactMode::anisotropic);
    CHECK(of_wisps() == 0);
    world.advance();
    CHECK(of_wisps() > 20);
}

TEST_CASE("the frame that is read is the world's own: its addresses stay") {
    World world = shaking_world();
    const Frame* frame = &world.frame();
    const Vec3* position = frame->position.data();
    const float* radius = frame->radius.data();
    const Vec3* vertices = world.body_vertices(0).data();
    advance(world, 2);
    SimulationDesc desc = world.desc();
    desc.gravity.y = -3;
    world.change(desc);
    World moved = std::move(world);
    moved.advance();
    CHECK(&moved.frame() == frame);
    CHECK(moved.frame().position.data() == position);
    CHECK(moved.frame().radius.data() == radius);
    CHECK(moved.body_vertices(0).data() == vertices);
}

TEST_CASE("a body's vertices are those of the frame, in frame 0 too") {
    Body bust = LiveHair::get().bust;
    bust.motion = shake_motion(0.5, 2);
    World world(LiveHair::get().desc, LiveHair::get().groom, {bust}, 0.1);
    for (int i = 0; i < 3; ++i, world.advance()) {
        std::vector<BonePose> bones(kBustBones);
        bust.motion->evaluate(world.frame().time, bones);
        // the top of the head follows its bone alone
        std::size_t top = 0;
        for (std::size_t v = 0; v < bust.mesh.vertices.size(); ++v)
            if (bust.mesh.vertices[v].y > bust.mesh.vertices[top].y)
                top = v;
        const Vec3d there = bones[kHeadBone].rotation.rotate(Vec3d(bust.mesh.vertices[top])) +
                            bones[kHeadBone].position - world.frame().origin;
        CHECK(length(Vec3d(world.body_vertices(0)[top]) - there) < 1e-6);
    }
}
