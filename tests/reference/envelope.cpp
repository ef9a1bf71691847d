/// §3.3: the envelope, K light point-masses around each skeleton point, each on its own half line.

#include "reference/twin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mane::reference {

/// M11: stiffer and stiffer in compression, weaker in stretching.
double radial_response(double ratio) {
    const double rho = std::max(ratio, 0.15);
    return (1 / rho - rho) / 2;
}

double ring_distance(const Wisp& wisp, std::size_t i, std::size_t k) {
    const std::size_t points = wisp.points();
    const double a = wisp.r[i][k], b = wisp.r[i][(k + 1) % points];
    const double C = std::cos(2 * std::numbers::pi / static_cast<double>(points));
    return std::max(std::sqrt(std::max(a * a + b * b - 2 * C * a * b, 0.0)), 1e-6);
}

namespace {

void add_radial_springs(const Wisp& wisp, std::size_t i, Ring& force) {
    for (std::size_t k = 0; k < wisp.points(); ++k) {
        const double rest = wisp.rest_radius[i][k];
        force[k] += wisp.radial_stiffness[i] * rest * radial_response(wisp.r[i][k] / rest);
        force[k] -= wisp.radial_damping[i] * wisp.r_rate[i][k];
    }
}

/// M12: "envelope points of the same cross section are also linked together by soft, highly damped
/// springs".
void add_ring_springs(const Wisp& wisp, std::size_t i, Ring& force) {
    const std::size_t points = wisp.points();
    const double C = std::cos(2 * std::numbers::pi / static_cast<double>(points));
    for (std::size_t k = 0; k < points; ++k) {
        const std::size_t next = (k + 1) % points;
        const double distance = ring_distance(wisp, i, k);
        const double along = (wisp.r[i][k] - C * wisp.r[i][next]) / distance;
        const double along_next = (wisp.r[i][next] - C * wisp.r[i][k]) / distance;
        const double speed = along * wisp.r_rate[i][k] + along_next * wisp.r_rate[i][next];
        const double tension = wisp.ring_stiffness[i] * (distance - wisp.ring_length[i][k]) +
                               wisp.ring_damping[i] * speed;
        force[k] -= tension * along;
        force[next] -= tension * along_next;
    }
}

} // namespace

Ring envelope_forces(const Wisp& wisp, std::size_t i) {
    Ring force(wisp.points(), 0.0);
    add_radial_springs(wisp, i, force);
    add_ring_springs(wisp, i, force);
    return force;
}

Matrix3 section_inertia(const Wisp& wisp, const SectionFrame& frame, std::size_t i) {
    Matrix3 T = Matrix3::scale(wisp.skeleton_mass[i]);
    for (std::size_t k = 0; k < wisp.points(); ++k) {
        const Vec3d d = half_line(frame, k, wisp.points());
        T += wisp.envelope_mass[i] * (Matrix3::scale(1) - Matrix3::outer(d, d));
    }
    return T;
}

} // namespace mane::reference
