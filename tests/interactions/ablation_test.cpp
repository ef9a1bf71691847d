/// Claims of the interactions, each measured with its mechanism and without it: what a twin would
/// copy, mistake included, is seen here (docs/proofs.md).

#include "bodies/meshes.h"
#include "interactions/literal_response.h"
#include "interactions/toy_hair.h"
#include "interactions/wisp_detection.h"
#include "interactions/wisp_response.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace mane;
using namespace mane::test;

namespace {

/// A wisp that runs along x and comes back in a loop over itself, along z and `height` higher: its
/// point 9 stands over the middle of its segment 2.
std::vector<Vec3> loop(float height) {
    return {{-0.03f, 0, 0},        {-0.01f, 0, 0},         {0.01f, 0, 0},
            {0.03f, 0, 0},         {0.06f, 0, 0.02f},      {0.07f, 0.02f, 0.05f},
            {0.05f, 0.04f, 0.07f}, {0.02f, height, 0.06f}, {0.02f, height, 0.03f},
            {0.02f, height, 0},    {0.02f, height, -0.03f}};
}

/// How far over the leg below point 9 is, where the upper leg comes down at 1 m/s for 0.2 s.
float lowest_in_loop(const Ablation& ablation) {
    constexpr float kStep = 1e-3f;
    ToyHair hair({loop(0.05f)}, 4, 0.01f);
    for (std::uint32_t i = 7; i < hair.groom.sections(0); ++i)
        hair.state.velocity.set(hair.slot(0, i), {0, -1, 0});
    Threads threads(1);
    const WispContactDesc desc;
    ContactGeometry geometry;
    WispDetection detection(desc, ablation);
    WispResponse response(desc);
    float lowest = 1;
    for (int step = 0; step < 200; ++step) {
        geometry.take(hair.view(), threads);
        detection.detect(hair.view(), geometry.points(), threads);
        response.engage(hair.view(), geometry, detection.list(), threads);
        response.prepare(geometry, kStep, threads);
        response.apply(hair.view(), geometry, hair.state, threads);
        for (std::uint32_t i = 2; i < hair.groom.sections(0); ++i) {
            const Slot slot = hair.slot(0, i);
            hair.state.position.set(slot, hair.x(0, i) + hair.v(0, i) * kStep);
            for (std::uint32_t k = 0; k < 4; ++k)
                hair.state.radius.at(slot, k) =
                    std::max(0.f, hair.state.radius.at(slot, k) +
                                      kStep * hair.state.radius_rate.at(slot, k));
        }
        hair.find_frames();
        lowest = std::min(lowest, hair.x(0, 9).y - (hair.x(0, 2).y + hair.x(0, 3).y) / 2);
    }
    return lowest;
}

} // namespace

TEST_CASE("M22: a wisp's loop that falls on its own lower leg does not pass it") {
    const float on = lowest_in_loop({}), off = lowest_in_loop({.self_collision = false});
    MESSAGE("lowest over the leg below: " << 1000 * on << " mm; without self-collision "
                                          << 1000 * off << " mm");
    // Velocities go to the average as soon as the axis is inside the other's radius of 10 mm.
    CHECK(on > 0);
    CHECK(off == doctest::Approx(0.05 - 0.2).epsilon(1e-3)); // free: 1 m/s for 0.2 s
}

TEST_CASE("M23: a quasi-parallel contact does not flicker when its directions waver about 30°") {
    const auto changes = [](float hysteresis) {
        WispContactDesc desc;
        desc.hysteresis = hysteresis;
        ContactGeometry geometry;
        WispDetection detection(desc);
        Threads threads(1);
        std::vector<WispContact> earlier;
        int count = 0;
        for (int i = 0; i < 20; ++i) {
            const float angle = (30 + (i % 2 ? 2.f : -2.f)) * std::numbers::pi_v<float> / 180;
            const Vec3 lean = Vec3{std::sin(angle), -std::cos(angle), 0} * 0.025f;
            const ToyHair hair({ToyHair::straight({0, 0.1f, 0}, {0, -0.025f, 0}, 8),
                                ToyHair::straight(lean * -4 + Vec3{0, 0, 0.006f}, lean, 8)},
                               4, 0.01f);
            geometry.take(hair.view(), threads);
            detection.detect(hair.view(), geometry.points(), threads);
            const auto contacts = detection.list().all(geometry.points().order);
            REQUIRE_FALSE(contacts.empty());
            for (const WispContact& now : contacts)
                for (const WispContact& was : earlier)
                    count += same_place(now, was) && now.kind != was.kind;
            earlier = contacts;
        }
        return count;
    };
    const int on = changes(WispContactDesc{}.hysteresis), off = changes(1);
    MESSAGE("changes of kind in 20 detections: " << on << "; without hysteresis " << off);
    CHECK(on == 0);
    CHECK(off >= 19); // each time, at least one contact
}

TEST_CASE("M21: axes that cross in one point are a contact like any other") {
    // Exactly: all numbers are whole multiples of a power of two.
    const ToyHair hair({ToyHair::straight({-0.25f, 0, 0}, {0.125f, 0, 0}, 5),
                        ToyHair::straight({0.0625f, 0, -0.3125f}, {0, 0, 0.125f}, 6)},
                       4, 0.0078125f);
    Threads threads(1);
    ContactGeometry geometry;
    WispDetection detection({});
    geometry.take(hair.view(), threads);
    detection.detect(hair.view(), geometry.points(), threads);
    std::size_t axes = 0;
    for (const WispContact& c : detection.list().all(geometry.points().order)) {
        CHECK(c.weight == 1);
        axes += c.point.is_axis();
    }
    CHECK(axes == 1);
}

TEST_CASE("M27a: an answer never adds energy, however many contacts share a point") {
    // One wisp moves across 17 that lie in each other.
    const auto energy_gain = [](bool literal) {
        std::vector<std::vector<Vec3>> wisps = {
            ToyHair::straight({-0.1f, 0, 0}, {0.025f, 0, 0}, 9)};
        for (int i = 0; i < 17; ++i)
            wisps.push_back(ToyHair::straight(
                {0.0005f * static_cast<float>(i - 8), 0.001f * static_cast<float>(i % 5), -0.1f},
                {0, 0, 0.025f}, 9));
        ToyHair hair(wisps, 4, 0.01f);
        for (std::uint32_t i = 2; i < hair.groom.sections(0); ++i)
            hair.state.velocity.set(hair.slot(0, i), {0, 1, 0});
        const double before = hair.energy({});
        WispContactDesc desc;
        desc.mode = WispContactMode::isotropic;
        desc.literal = literal;
        Threads threads(1);
        ContactGeometry geometry;
        WispDetection detection(desc);
        geometry.take(hair.view(), threads);
        detection.detect(hair.view(), geometry.points(), threads);
        REQUIRE(detection.list().size() > 17);
        if (literal) {
            respond_literally(hair.view(), detection.list().all(geometry.points().order), desc,
                              1e-3f, hair.state);
        } else {
            WispResponse response(desc);
            response.engage(hair.view(), geometry, detection.list(), threads);
            response.prepare(geometry, 1e-3f, threads);
            response.apply(hair.view(), geometry, hair.state, threads);
        }
        return hair.energy({}) / before;
    };
    const double on = energy_gain(false), off = energy_gain(true);
    MESSAGE("energy after one answer over before: " << on << "; with the literal ½ added up "
                                                    << off);
    CHECK(on < 1);
    CHECK(off > 1.5);
}

TEST_CASE("M30: a moving floor takes what lies on it along at its own velocity") {
    const auto shortfall = [](const Ablation& ablation) {
        constexpr double kSpeed = 2;
        ToyHair hair(
            {{{0, 1.1f, 0}, {0, 1, 0}, {-0.05f, 0.02f, 0}, {0, 0.02f, 0}, {0.05f, 0.02f, 0}}}, 4,
            0);
        ToyRun run(hair, {box({-1, -0.5f, -1}, {1, 0, 1}, 8)});
        run.contacts = CharacterContacts(ablation);
        run.gravity = {};
        for (int b = 0; b < 20; ++b)
            run.block([&](std::size_t, double t, const Vec3d& p) {
                return p + Vec3d{0, kSpeed * t, 0};
            });
        return std::abs(double(hair.v(0, 3).y) / kSpeed - 1);
    };
    const double on = shortfall({}), off = shortfall({.polygon_velocity = false});
    MESSAGE("velocity short of the floor's by " << 100 * on << " %; without the polygon's own "
                                                << 100 * off << " %");
    CHECK(on < 1e-4);
    CHECK(off > 0.99); // only ever shifted, never moved
}
