/// What the penetration reaction knows, against the queries that it saves.

#include "character/skinning.h"
#include "interactions/character_bearings.h"
#include "interactions/toy_hair.h"
#include "mane/character.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace mane;
using namespace mane::test;

namespace {

constexpr double kBlock = 1.0 / 120;
constexpr int kWisps = 300, kSections = 8;

struct Dice {
    std::mt19937 bits{7};
    float within(float low, float high) {
        return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f);
    }
    Vec3 ball(float size) {
        return {within(-size, size), within(-size, size), within(-size, size)};
    }
};

/// The built-in bust over one block of its whirl.
struct Whirl {
    Body bust = make_bust();
    Surface surface{bust.mesh};

    Whirl() {
        surface.reset(pose(5));
        surface.advance(pose(5 + kBlock), kBlock);
    }
    std::vector<Vec3> pose(double time) const {
        const auto motion = builtin_motion();
        std::vector<BonePose> bones(motion->bone_count());
        std::vector<Vec3> positions(bust.mesh.vertices.size()), velocities(positions.size());
        motion->evaluate(time, bones);
        pose_mesh(bust, bones, {}, positions, velocities);
        return positions;
    }
};

/// What a detection that searches as far as `radius` knows of a point.
CarriedPoint known_at_start(const Surface& surface, const Vec3& p, double radius) {
    CarriedPoint carried;
    carried.start = p;
    carried.clear = radius;
    if (const auto place = surface.start().nearest(Vec3d(p), radius)) {
        carried.clear = std::sqrt(place->closest.squared);
        carried.triangle = place->triangle;
    }
    return carried;
}

/// Whether the axis of a segment, what hangs on it and the way of its end cross nothing, each asked
/// for.
bool asked_free(const WispCopy& wisp, std::uint32_t i, const CarriedPoint& carried,
                const Escape& escape) {
    const auto free = [&](const Vec3& a, const Vec3& b) { return escape.free(0, a, b); };
    bool all = free(wisp.x[i - 1], wisp.x[i]) && free(carried.position, wisp.x[i]);
    const Vec3 centre = i > 2 ? wisp.halfway(i, {}) : wisp.x[i];
    all &= free(wisp.x[i], centre);
    for (std::uint32_t line = 0; line < wisp.k(); ++line) {
        for (const WispPoint& point : {WispPoint{i, 0, line, 1, 0}, wisp.half_arc(i, line)}) {
            all &= free(wisp.x[i], wisp.position(point));
            all &= i == 2 || free(centre, wisp.halfway(i, point));
        }
    }
    return all;
}

} // namespace

TEST_CASE("what the reaction knows without asking is what it would be told") {
    Dice dice;
    const Whirl whirl;
    const std::vector<ContactBody> bodies{{&whirl.surface, false}};
    Escape escape(bodies, 0.001);
    int free_segments = 0, told_free = 0, under = 0, inside = 0, free_axes = 0, crossed_axes = 0;
    for (int w = 0; w < kWisps; ++w) {
        // from the head's middle out and back: through ears, along the skin, and far away
        std::vector<Vec3> points{Vec3(0, 1.55f, 0) + dice.ball(0.12f)};
        const Vec3 way = dice.ball(0.05f);
        while (points.size() < kSections)
            points.push_back(points.back() + way + dice.ball(0.03f));
        ToyHair hair({points}, 4, 0.012f);
        hair.find_frames();
        WispCopy wisp;
        wisp.load(hair.view(), 0);
        std::vector<CarriedPoint> carried;
        for (Vec3& x : wisp.x) {
            carried.push_back(known_at_start(whirl.surface, x, dice.within(0, 0.15f)));
            x += dice.ball(0.01f);
            carried.back().near = true;
            carried.back().position = x + dice.ball(0.002f);
        }

        CharacterBearings bearings(wisp, bodies, escape);
        bearings.begin(carried);
        for (std::uint32_t i = 2; i < wisp.sections(); ++i) {
            if (dice.within(0, 1) < 0.2f) {
                wisp.x[i] += dice.ball(0.02f);
                bearings.forget(i);
            }
            if (dice.within(0, 1) < 0.2f) {
                wisp.r(i, 1) *= dice.within(0, 1);
                bearings.forget_envelope(i);
            }
            const Vec3 p = wisp.x[i];
            const bool free = asked_free(wisp, i, carried[i], escape);
            if (bearings.segment_free(i, 0))
                CHECK(free);
            free_segments += free;
            told_free += bearings.segment_free(i, 0);
            CHECK(bearings.inside(i, 0) == escape.inside(p, 0));
            CHECK(bearings.axis_free(i, 0) == escape.free(0, wisp.x[i - 1], p));
            inside += bearings.inside(i, 0);
            ++(bearings.axis_free(i, 0) ? free_axes : crossed_axes);

            const auto section = bearings.section_roof(i, 0);
            for (std::uint32_t line = 0; line < wisp.k(); ++line) {
                for (const WispPoint& point :
                     {WispPoint{i, 0, line, 1, 0}, wisp.half_arc(i, line)}) {
                    const Vec3 end = wisp.position(point);
                    if (!section.under(p, end))
                        continue;
                    CHECK(escape.free(0, p, end));
                    ++under;
                }
            }
            if (i == 2)
                continue;
            const auto halfway = bearings.halfway_roof(i, 0);
            const Vec3 centre = wisp.halfway(i, {});
            for (std::uint32_t line = 0; line < wisp.k(); ++line) {
                for (const WispPoint& point :
                     {WispPoint{i, 0, line, 1, 0}, wisp.half_arc(i, line)}) {
                    const Vec3 end = wisp.halfway(i, point);
                    if (!halfway.under(centre, end))
                        continue;
                    CHECK(escape.free(0, centre, end));
                    ++under;
                }
            }
        }
    }
    // each kind of answer was given
    CHECK(under > 10000);
    CHECK(free_segments > 1000);
    CHECK(told_free > free_segments / 2);
    CHECK(inside > 100);
    CHECK(free_axes > 100);
    CHECK(crossed_axes > 100);
}
