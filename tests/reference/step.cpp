/// §5.1: the order of a step. "A given wisp is processed from root to tip, the envelope
/// point-masses being processed after their associated skeleton point-mass."

#include "reference/twin.h"

#include <cmath>

namespace mane::reference {
namespace {

constexpr std::size_t kFirstSimulated = 2;

/// Velocities too small to matter become zero: their squares would be denormal numbers.
double without_dust(double velocity) {
    return std::abs(velocity) < 1e-15 ? 0 : velocity;
}
Vec3d without_dust(const Vec3d& velocity) {
    return {without_dust(velocity.x), without_dust(velocity.y), without_dust(velocity.z)};
}

} // namespace

/// M9, M13: envelope points obey m_e (r̈ + ẍ·d) = F·d; what is left of the forces on them, and the
/// reactions of their springs, act on the skeleton point.
Accelerations accelerations(const Wisp& wisp, const Surroundings& surroundings) {
    Accelerations a;
    a.x.resize(wisp.sections());
    a.r.assign(wisp.sections(), Ring(wisp.points(), 0.0));
    const std::vector<Vec3d> springs = skeleton_forces(wisp);
    const std::vector<SectionFrame> frames = section_frames(wisp);
    for (std::size_t i = kFirstSimulated; i < wisp.sections(); ++i) {
        const Ring Q = envelope_forces(wisp, i);
        Vec3d force = springs[i];
        for (std::size_t k = 0; k < wisp.points(); ++k)
            force -= Q[k] * half_line(frames[i], k, wisp.points());
        const Vec3d from_springs = section_inertia(wisp, frames[i], i).inverse() * force;

        // Gravity and air act alike on every point of a section, so they do not move its envelope.
        const Vec3d through_air = wisp.v[i] - wisp.air[i];
        a.x[i] = surroundings.gravity - surroundings.air_drag * through_air + from_springs;
        for (std::size_t k = 0; k < wisp.points(); ++k)
            a.r[i][k] = Q[k] / wisp.envelope_mass[i] - surroundings.air_drag * wisp.r_rate[i][k] -
                        dot(half_line(frames[i], k, wisp.points()), from_springs);
    }
    return a;
}

void set_root_position(Wisp& wisp, const Root& root) {
    wisp.x[0] = root.x0;
    wisp.x[1] = root.x1;
    wisp.u0 = root.u0;
}

void set_root_velocity(Wisp& wisp, const Root& root) {
    wisp.v[0] = root.v0;
    wisp.v[1] = root.v1;
}

void integrate_velocities(Wisp& wisp, const Accelerations& a, double h) {
    for (std::size_t i = kFirstSimulated; i < wisp.sections(); ++i) {
        wisp.v[i] = without_dust(wisp.v[i] + h * a.x[i]);
        for (std::size_t k = 0; k < wisp.points(); ++k)
            wisp.r_rate[i][k] = without_dust(wisp.r_rate[i][k] + h * a.r[i][k]);
    }
}

void integrate_positions(Wisp& wisp, double h) {
    for (std::size_t i = kFirstSimulated; i < wisp.sections(); ++i) {
        wisp.x[i] += h * wisp.v[i];
        for (std::size_t k = 0; k < wisp.points(); ++k) {
            wisp.r[i][k] += h * wisp.r_rate[i][k];
            if (wisp.r[i][k] < 0)
                wisp.r[i][k] = wisp.r_rate[i][k] = 0;
        }
    }
}

void step(Wisp& wisp, const Root& start, const Root& end, const Surroundings& surroundings,
          double h) {
    set_root_position(wisp, start);
    set_root_velocity(wisp, start);
    const Accelerations a = accelerations(wisp, surroundings);
    integrate_velocities(wisp, a, h);
    set_root_velocity(wisp, end);
    integrate_positions(wisp, h);
    set_root_position(wisp, end);
}

} // namespace mane::reference
