/// Sections that are held by hand (M46): exactly, smoothly, and felt by all else.

#include "step/live_hair.h"
#include "step/lone_wisp.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace mane;

namespace {

Vec3d section_place(const World& world, std::uint32_t section) {
    return world.frame().origin + Vec3d(world.frame().position[section]);
}

/// A limp wisp on a body that stands still, of segments that are all alike: a chain.
World chain() {
    LoneWisp lone;
    lone.shape.segments = 16;
    lone.shape.radius = 0.005f;
    lone.shape.skeleton.bending_length = 0.004f; // as good as none
    lone.shape.skeleton.strain = 0.01f;
    lone.shape.skeleton.stretch_damping = 0.3f;
    lone.desc.schedule.integration_rate = 4800;
    Groom groom = lone.groom();
    std::fill(groom.rest_length.begin() + 1, groom.rest_length.end(), groom.rest_length[1]);
    return World(lone.desc, groom, {make_peg(0.02f)});
}

/// The chain that hangs between x₁ and a point as high: all tensions follow from the horizontal
/// one, since the vertical ones are the weights below; each segment lies along its tension and is
/// stretched by it.
struct HangingChain {
    const Groom& groom;
    double width; ///< [m] between its two ends

    double tension(double horizontal, std::size_t i) const {
        const double v = vertical(i);
        return std::sqrt(horizontal * horizontal + v * v);
    }
    double length(double horizontal, std::size_t i) const {
        return groom.rest_length[i] * (1 + tension(horizontal, i) / groom.stretch_stiffness[i]);
    }
    double weight(std::size_t section) const {
        return 9.81 * (double{groom.skeleton_mass[section]} +
                       double{groom.envelope_mass[section]} * groom.envelope_points);
    }
    /// Of the pull on the lower end of segment i, upward toward x₁: half of the weight in the
    /// middle is each end's, by symmetry.
    double vertical(std::size_t i) const {
        const std::size_t tip = groom.section_count() - 1;
        double all = 0, before = 0;
        for (std::size_t s = 2; s < tip; ++s) {
            all += weight(s);
            before += s <= i ? weight(s) : 0;
        }
        return all / 2 - before;
    }
    /// The sections from x₁ to the tip.
    std::vector<Vec3d> shape() const {
        double low = 0, high = 10;
        while (high - low > 1e-15) {
            const double middle = (low + high) / 2;
            (points(middle).back().x < width ? low : high) = middle;
        }
        return points((low + high) / 2);
    }
    std::vector<Vec3d> points(double horizontal) const {
        std::vector<Vec3d> x = {{}};
        for (std::size_t i = 1; i + 1 < groom.section_count(); ++i)
            x.push_back(x.back() + Vec3d(horizontal, -vertical(i), 0) *
                                       (length(horizontal, i) / tension(horizontal, i)));
        return x;
    }
};

} // namespace

TEST_CASE("a chain pinned at its tip hangs as a chain between two points does") {
    World world = chain();
    const auto tip = static_cast<std::uint32_t>(world.groom().section_count() - 1);
    const double width = 0.25;
    world.pin({.section = tip, .place = section_place(world, 1) + Vec3d(width, 0, 0), .ease = 0.5});
    advance(world, 8 * 240);
    const std::vector<Vec3d> expected = HangingChain{world.groom(), width}.shape();
    CHECK(std::fabs(expected.back().y) < 1e-7); // as high as it began
    double off = 0, deepest = 0, uneven = 0;
    const auto at = [&](std::uint32_t s) {
        return section_place(world, s) - section_place(world, 1);
    };
    for (std::uint32_t s = 1; s <= tip; ++s) {
        off = std::max(off, length(at(s) - expected[s - 1]));
        deepest = std::max(deepest, -at(s).y);
        uneven = std::max(uneven, std::fabs(at(s).y - at(tip + 1 - s).y));
    }
    MESSAGE("hangs " << deepest * 1e3 << " mm deep, off by " << off * 1e6 << " µm, uneven by "
                     << uneven * 1e6 << " µm");
    CHECK(deepest > 0.1);
    CHECK(off < 3e-5); // what bending is left turns x₁'s joint
    CHECK(uneven < 3e-5);
    // It is at rest: speeds that are left move no place by half a unit in its last place per step.
    const Vec3d before = at(5);
    advance(world, 240);
    CHECK(length(at(5) - before) < 1e-9);
}

TEST_CASE(
    "a chain that is let go begins to fall as its weight and its last spring ask, no faster") {
    World world = chain();
    const auto tip = static_cast<std::uint32_t>(world.groom().section_count() - 1);
    world.pin({.section = tip, .place = section_place(world, 1) + Vec3d(0.25, 0, 0), .ease = 0.5});
    advance(world, 8 * 240);
    const Frame before = world.frame();

    SimulationDesc one_step = world.desc();
    one_step.schedule.frame_rate = 4800;
    world.change(one_step);
    world.release(tip);
    CHECK(world.frame().velocity == before.velocity); // no impulse
    CHECK(world.pins().empty());
    world.advance();

    const Groom& g = world.groom();
    const Vec3d last = Vec3d(before.position[tip - 1]) - Vec3d(before.position[tip]);
    const double strain = length(last) / double{g.rest_length[tip - 1]} - 1,
                 mass = double{g.skeleton_mass[tip]} +
                        double{g.envelope_mass[tip]} * g.envelope_points; // along the normal
    const Vec3d expected =
        Vec3d(0, -9.81, 0) +
        normalized(last) * (strain * double{g.stretch_stiffness[tip - 1]} / mass);
    const Vec3d found = Vec3d(world.frame().velocity[tip]) * 4800.0;
    MESSAGE("begins with " << length(found) << " m/s², expected " << length(expected));
    CHECK(length(found - expected) < 0.003 * length(expected));
    CHECK(length(expected) > 20); // the chain pulls more than the tip weighs
}

TEST_CASE("hair at rest does not feel a pin that holds it where it is, nor its release") {
    LiveHair calm = LiveHair::get();
    calm.desc.air.wind = {};
    calm.desc.air.gusts = 0;
    World world = calm.world(nullptr);
    advance(world, 36);
    const Frame rest = world.frame();
    for (std::size_t w = 0; w < 30; w += 3)
        world.pin({.section = world.groom().first_section[w] + 3});
    advance(world, 12);
    const auto moved = [&] {
        double most = 0;
        for (std::size_t s = 0; s < rest.position.size(); ++s)
            most = std::max(most, double{length(world.frame().position[s] - rest.position[s])});
        for (std::size_t r = 0; r < rest.radius.size();
             ++r) // gravity weighs on a held envelope too
            most = std::max(most, std::fabs(double{world.frame().radius[r] - rest.radius[r]}));
        return most;
    };
    MESSAGE("held: moved by " << moved() * 1e6 << " µm");
    CHECK(moved() < 5e-6);
    for (const Pin& pin : world.pins())
        world.release(pin.section);
    advance(world, 12);
    MESSAGE("released: moved by " << moved() * 1e6 << " µm");
    CHECK(moved() < 5e-6);
}

TEST_CASE("a pin that is released before it acted changes no bit") {
    World plain = LiveHair::get().world(shake_motion(0.5, 2)),
          pinned = LiveHair::get().world(shake_motion(0.5, 2));
    advance(plain, 5);
    advance(pinned, 5);
    const std::uint32_t section = pinned.groom().first_section[2] + 3;
    pinned.pin({.section = section});
    pinned.release(section);
    advance(plain, 5);
    advance(pinned, 5);
    CHECK(plain.state_hash() == pinned.state_hash());
}

TEST_CASE("a pinned section goes its way exactly, with its velocity, through whatever it meets") {
    World world = LiveHair::get().world(shake_motion(0.5, 2));
    advance(world, 6);
    const std::uint32_t section = world.groom().first_section[4] + 4;
    const Vec3d from = section_place(world, section), to = from + Vec3d(0.15, 0.05, 0.1),
                velocity(world.frame().velocity[section]);
    const double begun = world.frame().time, seconds = 0.4;
    world.pin({.section = section, .place = to, .ease = seconds});
    const std::uint64_t contacts_before = world.statistics().collision_contacts;
    while (world.frame().time < begun + 0.6) {
        world.advance();
        // C² from where it was, as it moved, to the place, at rest
        const double s = std::min(1.0, (world.frame().time - begun) / seconds);
        const double gone = s * s * s * (10 + s * (6 * s - 15)),
                     run = s - 6 * s * s * s + 8 * s * s * s * s - 3 * s * s * s * s * s;
        const double gone_rate = 30 * s * s * (1 - s) * (1 - s),
                     run_rate = 1 - 18 * s * s + 32 * s * s * s - 15 * s * s * s * s;
        const Vec3d place = to + (from - to) * (1 - gone) + velocity * (seconds * run);
        const Vec3d speed = (to - from) * (gone_rate / seconds) + velocity * (s < 1 ? run_rate : 0);
        CHECK(length(section_place(world, section) - place) < 2e-7);
        CHECK(length(Vec3d(world.frame().velocity[section]) - speed) < 1e-5);
    }
    CHECK(world.frame().velocity[section] == Vec3());
    CHECK(world.statistics().collision_contacts > contacts_before + 100);
    // the sections beside it are stretched by the springs, not torn off
    for (const std::uint32_t other : {section - 1, section + 1})
        CHECK(length(section_place(world, other) - section_place(world, section)) < 0.2);
}

TEST_CASE("a pin on a bone goes with it, at its velocity") {
    const auto motion = shake_motion(0.5, 2);
    World world = LiveHair::get().world(motion);
    advance(world, 2);
    const std::uint32_t section = world.groom().first_section[11] + 4;
    world.pin({.section = section, .body = 0, .bone = kHeadBone, .ease = 0.1});
    REQUIRE(world.pins().size() == 1);
    const Vec3d rest = *world.pins()[0].place;
    for (int i = 0; i < 12; ++i) {
        world.advance();
        if (i < 3)
            continue;
        std::vector<BonePose> bones(kBustBones);
        motion->evaluate(world.frame().time, bones);
        const auto& [p, q, v, w] = bones[kHeadBone];
        CHECK(length(section_place(world, section) - (q.rotate(rest) + p)) < 1e-7);
        CHECK(length(Vec3d(world.frame().velocity[section]) - (v + cross(w, q.rotate(rest)))) <
              1e-5);
    }
}

TEST_CASE("a pin stays with the hair that is teleported") {
    auto motion = std::make_shared<DrivenBust>();
    World world = LiveHair::get().world(motion);
    const std::uint32_t section = world.groom().first_section[2] + 4;
    world.pin({.section = section});
    advance(world, 6);
    const Pose by{{10, 0, 0}, {0, 1, 0, 0}};
    const Vec3d place = by.rotation.rotate(section_place(world, section)) + by.position;
    motion->jump(by);
    world.teleport();
    CHECK(length(*world.pins()[0].place - place) < 1e-6);
    advance(world, 6);
    CHECK(length(section_place(world, section) - place) < 1e-6);
    CHECK(length(world.frame().velocity[section]) < 1e-6f);
}

TEST_CASE(
    "a pin inside a body is held there all the same, and the rest of its wisp stays outside") {
    World world = LiveHair::get().world(nullptr);
    const std::uint32_t section = world.groom().first_section[9] + 4;
    const Vec3d inside(0, 1.55, 0); // the head's centre
    world.pin({.section = section, .place = inside, .ease = 0.3});
    advance(world, 20);
    CHECK(length(section_place(world, section) - inside) < 1e-7);
}

TEST_CASE("pins that cannot be are refused by name, and nothing changes") {
    World world = LiveHair::get().world(nullptr);
    world.advance();
    const std::uint64_t hash = world.state_hash();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refusal = [&](const Pin& pin) -> std::string {
        try {
            world.pin(pin);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    };
    CHECK(refusal({.section = 0}) == "pin of section 0: it is on the head; expected the third of "
                                     "its wisp or a later one");
    CHECK(refusal({.section = 1}).find("on the head") != std::string::npos);
    CHECK(refusal({.section = 100000}).starts_with("pin of section 100000: expected one of "));
    CHECK(refusal({.section = 3, .place = Vec3d(nan, 0, 0)}) ==
          "pin of section 3: its place is not finite");
    CHECK(refusal({.section = 3, .body = 1}) ==
          "pin of section 3: found body 1, expected one of 1");
    CHECK(refusal({.section = 3, .body = 0, .bone = 9}) ==
          "pin of section 3: found bone 9, expected one of 3");
    CHECK(refusal({.section = 3, .ease = 0}) ==
          "pin of section 3: ease is 0.000000; expected over 0 s");
    CHECK_THROWS_WITH_AS(world.release(3), "release of section 3: it is not pinned", InputError);
    CHECK(world.pins().empty());
    World plain = LiveHair::get().world(nullptr);
    plain.advance();
    CHECK(world.state_hash() == hash);
    world.advance();
    plain.advance();
    CHECK(world.state_hash() == plain.state_hash());
}
