/// M12–M14: sections keep their volume, push back on the skeleton, and deform as the wisp swings.

#include "reference/single_wisp.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace mane;
using namespace mane::reference;

namespace {

const Surroundings kWeightless = {.gravity = {}, .air_drag = 0};

/// Area of a section of quarter-ellipses, over π/4.
double area(const Ring& r) {
    double sum = 0;
    for (std::size_t k = 0; k < r.size(); ++k)
        sum += r[k] * r[(k + 1) % r.size()];
    return sum;
}

/// Steps a still wisp whose tip section is held squeezed on its first axis to `radius`, between two
/// plates.
void squeeze(Wisp& wisp, double radius, double seconds) {
    const Root root = still_root(wisp);
    const double h = 1e-3;
    for (double t = 0; t < seconds; t += h) {
        step(wisp, root, root, kWeightless, h);
        for (const std::size_t k : {0u, 2u}) {
            wisp.r.back()[k] = radius;
            wisp.r_rate.back()[k] = 0;
        }
    }
}

} // namespace

TEST_CASE("a section squeezed to half on one axis swells by a tenth on the other, and recovers in "
          "half a second") {
    const SingleWisp shape;
    Wisp wisp = shape.wisp();
    const double rest_area = area(wisp.r.back());
    squeeze(wisp, shape.radius / 2, 1);
    CHECK(wisp.r.back()[1] / shape.radius >= 1.10);
    CHECK(wisp.r.back()[3] == doctest::Approx(wisp.r.back()[1]).epsilon(1e-6));
    CHECK(std::abs(wisp.r_rate.back()[1]) < 1e-6); // at equilibrium

    const Root root = still_root(wisp);
    for (int i = 0; i < 500; ++i)
        step(wisp, root, root, kWeightless, 1e-3);
    CHECK(area(wisp.r.back()) / rest_area >= 0.95);
    MESSAGE("area after 0.5 s: " << area(wisp.r.back()) / rest_area);
}

TEST_CASE("a wisp pressed on one side is pushed away") {
    const SingleWisp shape;
    for (const std::size_t pressed : {0u, 1u, 2u, 3u}) {
        Wisp wisp = shape.wisp();
        const Vec3d side = half_line(section_frames(wisp).back(), pressed, wisp.points());
        const Root root = still_root(wisp);
        double pushed = 0;
        for (int i = 0; i < 100; ++i) {
            // A wall holds the envelope point where it found it, half a radius inside; the wisp
            // backs off.
            const double along = dot(wisp.x.back() - shape.length * shape.direction, side);
            const double radius = std::max(shape.radius / 2 - along, 0.0);
            if (wisp.r.back()[pressed] > radius) {
                wisp.r.back()[pressed] = radius;
                wisp.r_rate.back()[pressed] = -dot(wisp.v.back(), side);
            }
            step(wisp, root, root, kWeightless, 1e-3);
            pushed = -dot(wisp.x.back() - shape.length * shape.direction, side);
        }
        CHECK(pushed > 0.1 * shape.radius);
    }
}

TEST_CASE("the push on the skeleton is equal and opposite to the spring's") {
    Wisp wisp = SingleWisp{}.wisp();
    const std::size_t tip = wisp.sections() - 1;
    wisp.r[tip] = {0.010, 0.015, 0.015, 0.015};
    const Ring Q = envelope_forces(wisp, tip);
    const Vec3d d = half_line(section_frames(wisp)[tip], 0, 4);
    const Accelerations a = accelerations(wisp, kWeightless);
    // Opposite pairs share the section's inertia in its plane: the skeleton point and the two
    // points across d.
    const double mass = wisp.skeleton_mass[tip] + 2 * wisp.envelope_mass[tip];
    CHECK(dot(a.x[tip], d) == doctest::Approx(-(Q[0] - Q[2]) / mass).epsilon(1e-5));
    CHECK(dot(a.x[tip], d) < -1);
}

TEST_CASE("a swinging wisp's tip squashes and stretches by gravity and air alone") {
    SingleWisp shape;
    shape.direction = {1, 0, 0};
    shape.across = {0, 0, 1};
    shape.stretch_damping = 0.05;
    shape.bending_damping = 0.3;
    shape.tip_stiffness = 0.25;
    Wisp wisp = shape.wisp();
    const Root root = still_root(wisp);
    const Surroundings earth = {.gravity = {0, -9.81, 0}, .air_drag = 3};
    // By hand: one g across the section is a load of m_e g on a radial and two ring springs, so
    // (1/20) of the section's weight: about 20 % / 20 = 1 % of the radius at the root's stiffness,
    // 4 % at the tip's. A fall and a whip is a few g.
    double least = 1, most = 1;
    for (int i = 0; i < 2000; ++i) {
        step(wisp, root, root, earth, 1e-3);
        const auto [low, high] = std::minmax_element(wisp.r.back().begin(), wisp.r.back().end());
        least = std::min(least, *low / shape.radius);
        most = std::max(most, *high / shape.radius);
    }
    MESSAGE("tip radii between " << least << " and " << most << " of rest");
    CHECK(least < 0.98);
    CHECK(most > 1.02);
}
