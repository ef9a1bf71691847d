/// The mechanical energy that the forces are the gradient of, and that contacts may only lower.

#include "reference/twin.h"

#include <cmath>

namespace mane::reference {
namespace {

/// ½ M ẋ² + Σ ½ m_e |ẋ + ṙ d|²: an envelope point's own velocity, but for the turning of its frame,
/// which has no inertia in the model.
double kinetic_energy(const Wisp& wisp, const SectionFrame& frame, std::size_t i) {
    double sum = wisp.skeleton_mass[i] * dot(wisp.v[i], wisp.v[i]);
    for (std::size_t k = 0; k < wisp.points(); ++k) {
        const Vec3d v = wisp.v[i] + wisp.r_rate[i][k] * half_line(frame, k, wisp.points());
        sum += wisp.envelope_mass[i] * dot(v, v);
    }
    return sum / 2;
}

double gravity_energy(const Wisp& wisp, const SectionFrame& frame, std::size_t i,
                      const Vec3d& gravity) {
    double sum = -wisp.skeleton_mass[i] * dot(gravity, wisp.x[i]);
    for (std::size_t k = 0; k < wisp.points(); ++k)
        sum -= wisp.envelope_mass[i] *
               dot(gravity, wisp.x[i] + wisp.r[i][k] * half_line(frame, k, wisp.points()));
    return sum;
}

double stretch_energy(const Wisp& wisp, std::size_t i) {
    const double longer = segment_length(wisp, i) - wisp.rest_length[i];
    return wisp.stretch_stiffness[i] / wisp.rest_length[i] * longer * longer / 2;
}

double bend_energy(const Wisp& wisp, std::size_t i) {
    const Curvature kappa = curvature(wisp, i);
    const double du = kappa.u - wisp.rest_curvature_u[i], dv = kappa.v - wisp.rest_curvature_v[i];
    return bend_stiffness(wisp, i) * (du * du + dv * dv) / 2;
}

/// Minus the integral of the radial spring's response, 0 at ρ = 1; the response is constant under
/// 0.15.
double radial_potential(double rho) {
    if (rho < 0.15)
        return radial_potential(0.15) + radial_response(0.15) * (0.15 - rho);
    return ((rho * rho - 1) / 2 - std::log(rho)) / 2;
}

double radial_energy(const Wisp& wisp, std::size_t i) {
    double sum = 0;
    for (std::size_t k = 0; k < wisp.points(); ++k) {
        const double rest = wisp.rest_radius[i][k];
        sum += wisp.radial_stiffness[i] * rest * rest * radial_potential(wisp.r[i][k] / rest);
    }
    return sum;
}

double ring_energy(const Wisp& wisp, std::size_t i) {
    double sum = 0;
    for (std::size_t k = 0; k < wisp.points(); ++k) {
        const double longer = ring_distance(wisp, i, k) - wisp.ring_length[i][k];
        sum += wisp.ring_stiffness[i] * longer * longer / 2;
    }
    return sum;
}

} // namespace

Energy energy(const Wisp& wisp, const Vec3d& gravity) {
    Energy e;
    const std::vector<SectionFrame> frames = section_frames(wisp);
    for (std::size_t i = 2; i < wisp.sections(); ++i) {
        e.kinetic += kinetic_energy(wisp, frames[i], i);
        e.gravity += gravity_energy(wisp, frames[i], i, gravity);
        e.radial += radial_energy(wisp, i);
        e.ring += ring_energy(wisp, i);
    }
    for (std::size_t i = 1; i + 1 < wisp.sections(); ++i) {
        e.stretch += stretch_energy(wisp, i);
        e.bend += bend_energy(wisp, i);
    }
    return e;
}

} // namespace mane::reference
