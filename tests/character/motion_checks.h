#pragma once

#include "mane/body.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

/// Velocities and angular velocities of all bones are the derivatives of their poses: central
/// differences converge with order 2.
inline void check_rates(const mane::Motion& motion, double time) {
    using namespace mane;
    const std::size_t n = motion.bone_count();
    std::vector<BonePose> now(n), before(n), after(n);
    motion.evaluate(time, now);
    const auto errors = [&](double h) {
        motion.evaluate(time - h, before);
        motion.evaluate(time + h, after);
        double most = 0;
        for (std::size_t b = 0; b < n; ++b) {
            const Vec3d v = (after[b].position - before[b].position) / (2 * h);
            // the turn from before to after: twice its vector part is the angle, up to its cube
            const Quatd turn = after[b].rotation * before[b].rotation.conjugate();
            const Vec3d w = Vec3d(turn.x, turn.y, turn.z) * ((turn.w < 0 ? -2 : 2) / (2 * h));
            most =
                std::max({most, length(v - now[b].velocity), length(w - now[b].angular_velocity)});
        }
        return most;
    };
    CAPTURE(time);
    const double coarse = errors(2e-4), fine = errors(1e-4);
    CHECK(fine < 0.27 * coarse + 2e-9); // a quarter, but for rounding
    CHECK(fine < 1e-3);
}

/// No jump of position, velocity or acceleration at `time`, as sharp as `jerk` [m/s³, rad/s³]
/// allows.
inline void check_smooth(const mane::Motion& motion, double time, double jerk) {
    using namespace mane;
    const std::size_t n = motion.bone_count();
    const double h = 1e-4;
    std::vector<BonePose> a(n), b(n), c(n), d(n);
    motion.evaluate(time - h, a);
    motion.evaluate(time - 1e-9, b);
    motion.evaluate(time + 1e-9, c);
    motion.evaluate(time + h, d);
    CAPTURE(time);
    for (std::size_t k = 0; k < n; ++k) {
        CHECK(length(c[k].position - b[k].position) < 1e-7);
        CHECK(length(c[k].velocity - b[k].velocity) < 1e-5);
        CHECK(length(c[k].angular_velocity - b[k].angular_velocity) < 1e-5);
        const Vec3d linear = (d[k].velocity - c[k].velocity - b[k].velocity + a[k].velocity) / h;
        const Vec3d angular = (d[k].angular_velocity - c[k].angular_velocity -
                               b[k].angular_velocity + a[k].angular_velocity) /
                              h;
        CHECK(length(linear) < jerk * h);
        CHECK(length(angular) < jerk * h);
    }
}
