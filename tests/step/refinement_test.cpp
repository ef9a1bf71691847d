/// Parameters are physical: what a wisp does hardly depends on how finely it is cut, the step being
/// refined with it.

#include "step/lone_wisp.h"
#include "step/small_motion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>

using namespace mane;

namespace {

/// The damped bending springs ask for a step that falls with the square of the segment's length.
LoneWisp cut_into(std::uint32_t segments) {
    LoneWisp wisp;
    wisp.shape.segments = segments;
    const float fineness = std::max(1.f, static_cast<float>(segments) / 8);
    wisp.desc.schedule.integration_rate = 1000 * fineness * fineness;
    return wisp;
}

/// Time from the first to the third passage of the first mode through the middle, once the nudge is
/// over [s]. (The tip alone would show the second mode too.)
double first_period(std::uint32_t segments) {
    LoneWisp wisp = cut_into(segments);
    wisp.desc.air.drag = 0;
    const Groom groom = wisp.groom();
    const SmallMotion motion(groom);
    World world = wisp.world();
    while (world.frame().time <= Nudge::kSeconds)
        world.advance();
    double before = motion.first_mode(world.frame()), first = 0;
    for (int crossings = 0;;) {
        world.advance();
        const double now = motion.first_mode(world.frame()), dt = 1 / 240.0;
        if (before * now < 0) {
            const double time = world.frame().time - dt * now / (now - before);
            if (++crossings == 1)
                first = time;
            if (crossings == 3)
                return time - first;
        }
        before = now;
        REQUIRE(world.frame().time < 5);
    }
}

/// Where the tip of a wisp comes to rest that was made to hang and is held out sideways.
Vec3d bent_tip(std::uint32_t segments) {
    LoneWisp wisp = cut_into(segments);
    wisp.motion = std::make_shared<TurnedSideways>();
    wisp.shape.skeleton.bending_length = 0.2f; // stiff enough to stand out
    wisp.shape.skeleton.bending_damping = 0;   // it would ask for tiny steps,
    wisp.desc.air.drag = 12;                   // and the air brings the wisp to rest
    World world = wisp.world();
    while (world.frame().time < 3)
        world.advance();
    CHECK(length(world.frame().velocity.back()) < 1e-3f);
    return tip_of(world);
}

} // namespace

TEST_CASE("the first period does not depend on the number of segments") {
    std::map<std::uint32_t, double> period;
    for (const std::uint32_t segments : {4u, 8u, 16u, 32u})
        period[segments] = first_period(segments);
    for (const auto& [segments, seconds] : period) {
        const double off = seconds / period[32] - 1;
        MESSAGE(segments << " segments: period " << seconds << " s, off by " << 100 * off << " %");
        CHECK(std::abs(off) < (segments < 8 ? 0.06 : 0.03));
    }
}

TEST_CASE("the shape under gravity does not depend on the number of segments") {
    std::map<std::uint32_t, Vec3d> tip;
    for (const std::uint32_t segments : {4u, 8u, 16u, 32u})
        tip[segments] = bent_tip(segments);
    CHECK(tip[32].x > 0.1);  // it does stand out,
    CHECK(tip[32].y < -0.1); // and does bend
    for (const auto& [segments, place] : tip) {
        const double off = length(place - tip[32]) / 0.4;
        MESSAGE(segments << " segments: tip at (" << place.x << ", " << place.y << ") m, off by "
                         << 100 * off << " % of the length");
        CHECK(off < (segments < 8 ? 0.06 : 0.03));
    }
}
