/// The twin's forces against its energy, and against what physics asks of any spring.

#include "reference/single_wisp.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace mane;
using namespace mane::reference;

namespace {

struct Dice {
    std::mt19937_64 engine;
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53;
    }
    Vec3d vector(double size) {
        return {between(-size, size), between(-size, size), between(-size, size)};
    }
};

SingleWisp undamped(std::uint32_t points) {
    SingleWisp w;
    w.segments = 5;
    w.points = points;
    w.radial_damping = w.ring_damping = 0;
    return w;
}

/// Joints bent at random about `axis` (or any axis where it is zero), segments stretched, radii
/// squeezed, some under the limit of M11.
Wisp bent(const SingleWisp& shape, Dice& dice, double largest, const Vec3d& axis = {}) {
    Wisp wisp = shape.wisp();
    Vec3d t = shape.direction;
    for (std::size_t i = 1; i < wisp.sections(); ++i) {
        const Vec3d about = normalized(length(axis) > 0 ? axis : cross(t, dice.vector(1)));
        const double angle = dice.between(-largest, largest);
        t = normalized(std::cos(angle) * t + std::sin(angle) * cross(about, t));
        wisp.x[i] = wisp.x[i - 1] + dice.between(0.9, 1.1) * wisp.rest_length[i - 1] * t;
        for (double& r : wisp.r[i])
            r *= dice.between(0.05, 1.5);
    }
    return wisp;
}

/// Any rest bend at every joint.
void bend_at_rest(Wisp& wisp, Dice& dice) {
    for (std::size_t i = 1; i < wisp.sections(); ++i) {
        wisp.rest_curvature_u[i] = dice.between(-3, 3);
        wisp.rest_curvature_v[i] = dice.between(-3, 3);
    }
}

/// What pushes skeleton point i and envelope point (i, k), from the accelerations and the inertia
/// of M9.
Vec3d push_on_skeleton(const Wisp& wisp, const Accelerations& a, std::size_t i) {
    const SectionFrame frame = section_frames(wisp)[i];
    Vec3d force = wisp.skeleton_mass[i] * a.x[i];
    for (std::size_t k = 0; k < wisp.points(); ++k)
        force += wisp.envelope_mass[i] * (a.x[i] + a.r[i][k] * half_line(frame, k, wisp.points()));
    return force;
}
double push_on_envelope(const Wisp& wisp, const Accelerations& a, std::size_t i, std::size_t k) {
    const Vec3d d = half_line(section_frames(wisp)[i], k, wisp.points());
    return wisp.envelope_mass[i] * (a.r[i][k] + dot(a.x[i], d));
}

/// Minus the slope of the elastic energy along one coordinate, by central differences.
double slope(const Wisp& wisp, const std::function<double&(Wisp&)>& coordinate) {
    const double h = 1e-7;
    Wisp low = wisp, high = wisp;
    coordinate(low) -= h;
    coordinate(high) += h;
    return (energy(low, {}).elastic() - energy(high, {}).elastic()) / (2 * h);
}

/// Energies of 1e-3 J differenced over 2e-7 m: rounding leaves 1e-12 N, curvature of the energy
/// less than 1e-7 of the largest force.
void check_gradient(const Wisp& wisp) {
    const Accelerations a = accelerations(wisp, {.gravity = {}, .air_drag = 0});
    for (std::size_t i = 2; i < wisp.sections(); ++i) {
        const Vec3d push = push_on_skeleton(wisp, a, i);
        const double tolerance = 1e-6 * (1e-3 + length(push));
        CHECK(std::abs(push.x - slope(wisp, [i](Wisp& w) -> double& { return w.x[i].x; })) <
              tolerance);
        CHECK(std::abs(push.y - slope(wisp, [i](Wisp& w) -> double& { return w.x[i].y; })) <
              tolerance);
        CHECK(std::abs(push.z - slope(wisp, [i](Wisp& w) -> double& { return w.x[i].z; })) <
              tolerance);
        for (std::size_t k = 0; k < wisp.points(); ++k) {
            const double out = push_on_envelope(wisp, a, i, k);
            CHECK(std::abs(out - slope(wisp, [i, k](Wisp& w) -> double& { return w.r[i][k]; })) <
                  1e-6 * (1e-3 + std::abs(out)));
        }
    }
}

} // namespace

TEST_CASE("forces are minus the gradient of the energy: straight at rest, bent any way") {
    // Without a rest curvature the bend's energy is ½ k θ², and does not know how the frames are
    // turned about the curve.
    Dice dice{std::mt19937_64(1)};
    for (const std::uint32_t points : {3u, 4u, 5u, 8u})
        for (int trial = 0; trial < 20; ++trial)
            check_gradient(bent(undamped(points), dice, 2.9));
}

TEST_CASE("forces are minus the gradient of the energy: bent at rest, bent any way") {
    // Moving a point turns the frames carried past it about the curve, and the rest curvature of
    // every later joint with them. Up to 150°, where the frames are carried in full.
    Dice dice{std::mt19937_64(2)};
    for (int trial = 0; trial < 40; ++trial) {
        Wisp wisp = bent(undamped(4), dice, 1.2);
        bend_at_rest(wisp, dice);
        check_gradient(wisp);
    }
}

TEST_CASE("the bending spring is the paper's: a moment linear in the angle") {
    SingleWisp shape = undamped(4);
    shape.segments = 2;
    Wisp wisp = shape.wisp();
    const double l = wisp.rest_length[1];
    for (const double angle : {0.0, 1e-5, 1e-3, 0.1, 1.0, 2.0, 3.0, 3.14}) {
        wisp.x[2] = wisp.x[1] + l * Vec3d{0, -1, 0};
        wisp.x[3] = wisp.x[2] + l * Vec3d{std::sin(angle), -std::cos(angle), 0};
        const Curvature kappa = curvature(wisp, 2);
        CHECK(std::hypot(kappa.u, kappa.v) == doctest::Approx(angle).epsilon(1e-7));
        // The couple on the last segment: stiffness · θ / l at its tip, across it and against the
        // bend.
        const Vec3d tip = skeleton_forces(wisp)[3];
        const Vec3d against = {-std::cos(angle), -std::sin(angle), 0};
        CHECK(dot(tip, against) ==
              doctest::Approx(wisp.bend_stiffness[2] * angle / l).epsilon(1e-7));
        CHECK(std::abs(tip.z) < 1e-15);
    }
}

TEST_CASE("internal forces sum to zero and have no moment, springs and dampers, any state") {
    Dice dice{std::mt19937_64(3)};
    SingleWisp shape = undamped(4);
    shape.stretch_damping = 0.5;
    shape.thickness_power = 2;
    for (int trial = 0; trial < 100; ++trial) {
        // A rest bend turns the wisp about its root, which the head holds: no such moment without.
        Wisp wisp = bent(shape, dice, 3.1);
        for (Vec3d& v : wisp.v)
            v = dice.vector(2);
        Vec3d sum, moment;
        double size = 0;
        const std::vector<Vec3d> force = skeleton_forces(wisp);
        for (std::size_t i = 0; i < wisp.sections(); ++i) {
            sum += force[i];
            moment += cross(wisp.x[i], force[i]);
            size += length(force[i]);
        }
        CHECK(length(sum) < 1e-14 * size);
        CHECK(length(moment) < 1e-14 * size);
    }
}

TEST_CASE("the twist of bent rest shapes sums to zero too") {
    Dice dice{std::mt19937_64(7)};
    for (int trial = 0; trial < 100; ++trial) {
        Wisp wisp = bent(undamped(4), dice, 3.1);
        bend_at_rest(wisp, dice);
        Vec3d sum;
        double size = 0;
        for (const Vec3d& f : skeleton_forces(wisp)) {
            sum += f;
            size += length(f);
        }
        CHECK(length(sum) < 1e-13 * size);
    }
}

TEST_CASE(
    "two sections' worth of springs cannot push a free wisp: momentum is kept, envelope included") {
    Dice dice{std::mt19937_64(4)};
    for (const std::uint32_t points : {3u, 4u, 6u}) {
        Wisp wisp = bent(undamped(points), dice, 1.5);
        wisp.stretch_stiffness[1] = wisp.bend_stiffness[1] = wisp.bend_stiffness[2] =
            0; // cut from its root
        const Accelerations a = accelerations(wisp, {.gravity = {}, .air_drag = 0});
        Vec3d sum;
        double size = 0;
        for (std::size_t i = 2; i < wisp.sections(); ++i) {
            sum += push_on_skeleton(wisp, a, i);
            size += length(push_on_skeleton(wisp, a, i));
        }
        CHECK(size > 1e-3);
        CHECK(length(sum) < 1e-13 * size);
    }
}

TEST_CASE("damping only takes energy") {
    Dice dice{std::mt19937_64(5)};
    SingleWisp still = undamped(5), damped = still;
    damped.stretch_damping = 0.3;
    damped.bending_damping = 0.3;
    damped.radial_damping = damped.ring_damping = 1;
    for (int trial = 0; trial < 200; ++trial) {
        Wisp wisp = bent(damped, dice, 2.9);
        Wisp twin = wisp;
        const Wisp reference = still.wisp();
        twin.stretch_damping = reference.stretch_damping;
        twin.bend_damping = reference.bend_damping;
        twin.radial_damping = reference.radial_damping;
        twin.ring_damping = reference.ring_damping;
        for (std::size_t i = 2; i < wisp.sections(); ++i) {
            twin.v[i] = wisp.v[i] = dice.vector(1);
            for (std::size_t k = 0; k < wisp.points(); ++k)
                twin.r_rate[i][k] = wisp.r_rate[i][k] = dice.between(-1, 1);
        }
        const Surroundings vacuum = {.gravity = {}, .air_drag = 0};
        const Accelerations with = accelerations(wisp, vacuum),
                            without = accelerations(twin, vacuum);
        double power = 0;
        for (std::size_t i = 2; i < wisp.sections(); ++i) {
            power += dot(push_on_skeleton(wisp, with, i) - push_on_skeleton(wisp, without, i),
                         wisp.v[i]);
            for (std::size_t k = 0; k < wisp.points(); ++k)
                power +=
                    (push_on_envelope(wisp, with, i, k) - push_on_envelope(wisp, without, i, k)) *
                    wisp.r_rate[i][k];
        }
        CHECK(power < 0);
    }
}
