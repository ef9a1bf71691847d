/// Other springs, masses and radii while a world runs (M46).

#include "step/live_hair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace mane;

namespace {

World shaking_world() {
    return LiveHair::get().world(shake_motion(0.5, 2));
}
Groom wider(float factor) {
    return LiveHair::get().with([&](WispDesign& wisp) {
        for (float& r : wisp.radius)
            r *= factor;
    });
}
Groom stiffer() {
    return LiveHair::get().with([](WispDesign& wisp) {
        wisp.skeleton.strain = 0.008f;
        wisp.skeleton.bending_length *= 1.1f;
        wisp.envelope.squeeze = 0.25f;
        wisp.strands += 100;
    });
}

} // namespace

TEST_CASE("the same groom again changes no bit, nor does one that is taken back at once") {
    World plain = shaking_world(), changed = shaking_world();
    for (int i = 0; i < 8; ++i) {
        changed.change(stiffer());
        changed.change(wider(1.3f));
        changed.change(LiveHair::get().groom);
        plain.advance();
        changed.advance();
        REQUIRE(plain.state_hash() == changed.state_hash());
    }
}

TEST_CASE("other springs before the first step are those of a world made with them") {
    Body bust = LiveHair::get().bust;
    bust.motion = shake_motion(0.5, 2);
    World made(LiveHair::get().desc, stiffer(), {bust}), changed = shaking_world();
    changed.change(stiffer());
    advance(made, 6);
    advance(changed, 6);
    CHECK(made.state_hash() == changed.state_hash());
    CHECK(made.state_hash() != [] {
        World plain = shaking_world();
        advance(plain, 6);
        return plain.state_hash();
    }());
}

TEST_CASE("hair stays as it is when its springs change, and goes over to the new design") {
    LiveHair calm = LiveHair::get();
    calm.desc.air.wind = {};
    calm.desc.air.gusts = 0;
    calm.desc.wisps.mode = WispContactMode::off; // wider wisps would press on each other
    World world = calm.world(nullptr);
    advance(world, 24);
    const Frame before = world.frame();
    const Groom next = wider(1.15f);
    world.change(next);
    CHECK(world.frame().radius == before.radius);
    CHECK(world.frame().velocity == before.velocity);
    world.advance();
    const std::uint32_t k_count = next.envelope_points;
    /// The radii of sections `first` … `last` of each wisp that are not yet as designed, to a
    /// share.
    const auto off = [&](std::uint32_t first, std::uint32_t last, double share) {
        int count = 0;
        for (std::size_t w = 0; w < next.wisp_count(); ++w)
            for (std::uint32_t s = first; s <= std::min(last, next.sections(w) - 1); ++s)
                for (std::uint32_t k = 0; k < k_count; ++k) {
                    const std::size_t r = (next.first_section[w] + s) * k_count + k;
                    count +=
                        std::fabs(double{world.frame().radius[r] / next.radius[r]} - 1) > share;
                }
        return count;
    };
    CHECK(off(0, 1, 0) == 0); // on the head, within the frame
    for (std::size_t i = 0; i < 2 * k_count; ++i)
        CHECK(world.frame().radius_rate[i] == 0);
    const int all = off(2, 99, -1);
    CHECK(off(2, 99, 0.02) > all / 2); // the springs take longer
    double fastest = 0;
    for (int i = 0; i < 48; ++i) {
        world.advance();
        for (const float rate : world.frame().radius_rate)
            fastest = std::max(fastest, std::fabs(double{rate}));
    }
    MESSAGE("radii grew at up to " << fastest << " m/s; " << off(2, 99, 0.02) << " of " << all
                                   << " more than 2 % off in the end, beside the skin");
    CHECK(off(2, 99, 0.02) < all / 10);
    CHECK(fastest < 0.5);
}

TEST_CASE("grooms that do not fit, or would be unstable, are refused and change nothing") {
    World plain = shaking_world(), asked = shaking_world();
    advance(plain, 3);
    advance(asked, 3);
    const auto refusal = [&](const Groom& groom) -> std::string {
        try {
            asked.change(groom);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    const Groom& now = LiveHair::get().groom;
    CHECK(refusal(LiveHair::get().with([](WispDesign& w) {
              w.skeleton.strain = 2e-4f;
          })).find("mostly by skeleton.strain") != std::string::npos);
    CHECK(refusal(make_groom(std::span(LiveHair::get().designs).first(29),
                             LiveHair::get().bust.mesh)) ==
          "a groom of 29 wisps; expected the world's 30");
    CHECK(refusal(LiveHair::get().with([](WispDesign& w) {
              w.position.pop_back();
              w.radius.resize(w.position.size() * 4);
          })).find("sections; expected the world's") != std::string::npos);
    Groom broken = now;
    broken.roots[3].triangle += 1;
    CHECK(refusal(broken) == "wisp 3 is rooted elsewhere; expected the world's root");
    broken = now;
    broken.bend_stiffness[5] = std::numeric_limits<float>::quiet_NaN();
    CHECK(refusal(broken) == "a groom whose bend_stiffness 5 is not finite");
    broken = now;
    broken.rest_radius.pop_back();
    CHECK(refusal(broken).find("entries of rest_radius") != std::string::npos);
    broken = now;
    broken.skeleton_mass[4] = 0;
    CHECK(refusal(broken).find("section 4 has no mass") != std::string::npos);
    advance(plain, 3);
    advance(asked, 3);
    CHECK(plain.state_hash() == asked.state_hash());
}

TEST_CASE("a step that is too long for the old springs can come with softer ones") {
    World world = shaking_world();
    advance(world, 2);
    SimulationDesc longer = world.desc();
    longer.schedule.integration_rate = 1000;
    CHECK_THROWS_AS(world.change(longer), InputError);
    const Groom softer = LiveHair::get().with([](WispDesign& wisp) {
        wisp.skeleton.strain = 0.02f;
        wisp.envelope.squeeze = 0.5f;
        wisp.skeleton.bending_damping *= 0.3f;
    });
    world.change(longer, softer);
    advance(world, 4);
    CHECK(world.statistics().steps == 2 * 60 + 4 * 42);
}

TEST_CASE("roots of another design are reached within a frame, without a jump") {
    // Wisps that stand up more: x₀ and the first axis are elsewhere, on the same place of the skin.
    const LiveHair& live = LiveHair::get();
    HairDesc steep = live.hair;
    steep.style.root_angle = 50;
    const Groom next =
        make_groom(lay_style(steep, live.bust, bust_scalp(live.bust)), live.bust.mesh);
    World world = live.world(shake_motion(0.5, 2)), made = [&] {
        Body body = live.bust;
        body.motion = shake_motion(0.5, 2);
        return World(live.desc, next, {body});
    }();
    advance(world, 3);
    advance(made, 4);
    const Frame before = world.frame();
    world.change(next);
    CHECK(world.frame().position == before.position);
    world.advance();
    double off = 0, way = 0;
    for (std::size_t w = 0; w < next.wisp_count(); ++w)
        for (std::uint32_t s = next.first_section[w]; s < next.first_section[w] + 2; ++s) {
            off =
                std::max(off, double{length(world.frame().position[s] - made.frame().position[s])});
            off =
                std::max(off, double{length(world.frame().velocity[s] - made.frame().velocity[s])});
            way = std::max(way, double{length(next.position[s] - live.groom.position[s])});
        }
    CHECK(way > 0.003);
    CHECK(off < 1e-6);
    CHECK(world.frame().first_axis[0] == made.frame().first_axis[0]);
    advance(world, 12);
}
