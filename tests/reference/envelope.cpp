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

SectionInertia::SectionInertia(const Wisp& wisp, const SectionFrame& frame, std::size_t i) {
    const double m = wisp.envelope_mass[i];
    const double all = wisp.skeleton_mass[i] + static_cast<double>(wisp.points()) * m;
    row_[0] = {all, 0, 0};
    row_[1] = {0, all, 0};
    row_[2] = {0, 0, all};
    for (std::size_t k = 0; k < wisp.points(); ++k) {
        const Vec3d d = half_line(frame, k, wisp.points());
        row_[0] -= m * d.x * d;
        row_[1] -= m * d.y * d;
        row_[2] -= m * d.z * d;
    }
}

Vec3d SectionInertia::times(const Vec3d& velocity) const {
    return {dot(row_[0], velocity), dot(row_[1], velocity), dot(row_[2], velocity)};
}

Vec3d SectionInertia::solve(const Vec3d& force) const {
    // The matrix is symmetric: its rows are its columns, and Cramer's rule reads directly.
    const double determinant = dot(row_[0], cross(row_[1], row_[2]));
    return Vec3d{dot(force, cross(row_[1], row_[2])), dot(row_[0], cross(force, row_[2])),
                 dot(row_[0], cross(row_[1], force))} /
           determinant;
}

} // namespace mane::reference
