/// M7, M8: the sections' frames.

#include "reference/single_wisp.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace mane;
using namespace mane::reference;

namespace {

/// A wisp whose directions wander with `phase`, each joint bent by up to `sharpest` in every
/// direction.
Wisp waving(const SingleWisp& shape, double phase, double sharpest) {
    Wisp wisp = shape.wisp();
    Vec3d t = shape.direction;
    for (std::size_t i = 1; i < wisp.sections(); ++i) {
        wisp.x[i] = wisp.x[i - 1] + wisp.rest_length[0] * t;
        const double turn = phase + 1.7 * static_cast<double>(i);
        const Vec3d about =
            normalized(cross(t, Vec3d{std::cos(turn), 0.3 * std::sin(2 * turn), std::sin(turn)}));
        const double angle = sharpest * std::sin(phase + static_cast<double>(i * i));
        t = normalized(std::cos(angle) * t + std::sin(angle) * cross(about, t));
    }
    return wisp;
}

double degrees_between(const SectionFrame& a, const SectionFrame& b) {
    const double trace = dot(a.n, b.n) + dot(a.u, b.u) + dot(a.v, b.v);
    return std::acos(std::min(1.0, (trace - 1) / 2)) * 180 / std::numbers::pi;
}

} // namespace

TEST_CASE("frames are orthonormal, and their planes bisect the neighbouring segments") {
    for (double phase = 0; phase < 6; phase += 0.1) {
        const Wisp wisp = waving(SingleWisp{}, phase, 2.9);
        const std::vector<SectionFrame> frames = section_frames(wisp);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const auto& [n, u, v] = frames[i];
            CHECK(length(u) == doctest::Approx(1).epsilon(1e-14));
            CHECK(length(v) == doctest::Approx(1).epsilon(1e-14));
            CHECK(std::abs(dot(u, n)) < 1e-14);
            CHECK(std::abs(dot(u, v)) < 1e-14);
            CHECK(length(cross(u, v) - n) < 1e-14);
            if (i > 0 && i + 1 < frames.size())
                CHECK(std::abs(dot(segment_direction(wisp, i), n) -
                               dot(segment_direction(wisp, i - 1), n)) < 1e-13);
        }
    }
}

TEST_CASE("each frame is the one before turned by the least rotation between their planes") {
    // Least: about the line where the two planes meet, so the axis of the rotation lies in both.
    const Wisp wisp = waving(SingleWisp{}, 0.4, 1.2);
    const std::vector<SectionFrame> frames = section_frames(wisp);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const SectionFrame &a = frames[i - 1], &b = frames[i];
        const Vec3d axis = normalized(cross(a.n, b.n));
        CHECK(dot(axis, a.u) == doctest::Approx(dot(axis, b.u)).epsilon(1e-12));
        CHECK(dot(axis, a.v) == doctest::Approx(dot(axis, b.v)).epsilon(1e-12));
        CHECK(degrees_between(a, b) ==
              doctest::Approx(std::acos(dot(a.n, b.n)) * 180 / std::numbers::pi).epsilon(1e-9));
    }
}

TEST_CASE("frames of a straight or plane wisp do not twist") {
    const SingleWisp shape;
    for (const SectionFrame& frame : section_frames(shape.wisp()))
        CHECK(length(frame.u - shape.across) < 1e-14);

    Wisp arc = shape.wisp(); // in the plane across u
    for (std::size_t i = 0; i < arc.sections(); ++i) {
        const double angle = 0.4 * static_cast<double>(i);
        arc.x[i] = {0, -std::sin(angle), 1 - std::cos(angle)};
    }
    for (const SectionFrame& frame : section_frames(arc))
        CHECK(length(frame.u - shape.across) < 1e-14);
}

TEST_CASE("a closed motion brings the frames back exactly, by any way") {
    // The first segment goes round a cone and back. A frame that followed its own section through
    // time would come back turned by the cone's solid angle, 2π (1 − cos 40°) = 84°; these depend
    // on the present curve alone, to the last bit.
    const SingleWisp shape;
    Wisp wisp = waving(shape, 0.7, 2.5);
    const std::vector<Vec3d> start = wisp.x;
    const std::vector<SectionFrame> before = section_frames(wisp);
    const double tilt = 40 * std::numbers::pi / 180;
    double farthest = 0;
    for (int i = 1; i <= 100; ++i) {
        const double around = 2 * std::numbers::pi * i / 100;
        for (std::size_t j = 2; j < wisp.sections(); ++j)
            wisp.x[j] = wisp.x[1] + length(start[j] - start[1]) *
                                        Vec3d{std::sin(tilt) * std::cos(around), -std::cos(tilt),
                                              std::sin(tilt) * std::sin(around)};
        farthest = std::max(farthest, degrees_between(before.back(), section_frames(wisp).back()));
    }
    CHECK(farthest > 20);
    wisp.x = start;
    const std::vector<SectionFrame> after = section_frames(wisp);
    for (std::size_t i = 0; i < after.size(); ++i) {
        CHECK(after[i].u == before[i].u);
        CHECK(after[i].v == before[i].v);
    }
}

TEST_CASE("frames at a folded joint and at a vanishing segment are defined") {
    SingleWisp shape;
    shape.segments = 6;
    Wisp folded = shape.wisp(); // at section 4, back along itself
    for (std::size_t i = 5; i < folded.sections(); ++i)
        folded.x[i] = folded.x[8 - i];
    Wisp vanishing = SingleWisp{}.wisp();
    for (std::size_t i = 5; i < vanishing.sections(); ++i)
        vanishing.x[i] += vanishing.x[4] - vanishing.x[5];
    for (const Wisp& wisp : {folded, vanishing})
        for (const SectionFrame& frame : section_frames(wisp)) {
            CHECK(length(frame.u) == doctest::Approx(1).epsilon(1e-12));
            CHECK(length(frame.v) == doctest::Approx(1).epsilon(1e-12));
            CHECK(length(frame.n) == doctest::Approx(1).epsilon(1e-12));
        }
}
