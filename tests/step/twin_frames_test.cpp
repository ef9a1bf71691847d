/// M8 in motion: frames are steady from step to step.

#include "reference/single_wisp.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace mane;
using namespace mane::reference;

namespace {

/// A head of radius 0.1 m that yaws by ±40° at 1 Hz, with a wisp rooted on its side.
Root yawing(double t) {
    const double w = 2 * std::numbers::pi, size = 40 * std::numbers::pi / 180;
    const double angle = size * std::sin(w * t), rate = size * w * std::cos(w * t);
    const Vec3d out = {std::cos(angle), 0, -std::sin(angle)}, turn = {0, rate, 0};
    const Vec3d x0 = 0.09 * out, x1 = 0.1 * out + Vec3d{0, -0.03, 0};
    return {x0, x1, cross(turn, x0), cross(turn, x1), {std::sin(angle), 0, std::cos(angle)}};
}

double degrees_between(const SectionFrame& a, const SectionFrame& b) {
    const double trace = dot(a.n, b.n) + dot(a.u, b.u) + dot(a.v, b.v);
    return std::acos(std::clamp((trace - 1) / 2, -1.0, 1.0)) * 180 / std::numbers::pi;
}

double sharpest_joint(const Wisp& wisp) {
    double sharpest = 0;
    for (std::size_t i = 1; i + 1 < wisp.sections(); ++i) {
        const double cosine = dot(segment_direction(wisp, i - 1), segment_direction(wisp, i));
        sharpest =
            std::max(sharpest, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi);
    }
    return sharpest;
}

} // namespace

TEST_CASE(
    "no frame turns by more than 5° in a step of a shaken wisp while joints bend less than 150°") {
    SingleWisp shape;
    shape.stretch_damping = 0.05;
    shape.bending_damping = 0.3;
    Wisp wisp = shape.wisp();
    const double h = 1e-3;
    for (std::size_t i = 0; i < wisp.sections(); ++i)
        wisp.x[i] += yawing(0).x1;
    set_root_position(wisp, yawing(0));
    std::vector<SectionFrame> before = section_frames(wisp);
    double most = 0, sharpest = 0;
    for (int i = 0; i < 4000; ++i) {
        step(wisp, yawing(i * h), yawing((i + 1) * h), {.gravity = {0, -9.81, 0}, .air_drag = 3},
             h);
        const std::vector<SectionFrame> now = section_frames(wisp);
        for (std::size_t k = 0; k < now.size(); ++k)
            most = std::max(most, degrees_between(before[k], now[k]));
        sharpest = std::max(sharpest, sharpest_joint(wisp));
        before = now;
    }
    MESSAGE("largest turn " << most << "° a step, sharpest joint " << sharpest << "°");
    REQUIRE(sharpest < 150);
    CHECK(most > 0.1);
    CHECK(most < 5);
}
