#include "reference/single_wisp.h"

#include <cmath>
#include <numbers>

namespace mane::reference {
namespace {

/// Mass of section i: half of each neighbouring simulated segment.
double section_mass(const SingleWisp& w, std::uint32_t i) {
    const double segment = w.mass_per_length * w.length / w.segments;
    if (i == 0)
        return 0;
    return i == 1 || i == w.segments + 1 ? segment / 2 : segment;
}

void add_masses(const SingleWisp& w, std::uint32_t i, Groom& groom) {
    const double mass = section_mass(w, i);
    groom.skeleton_mass.push_back(static_cast<float>((1 - w.mass_share) * mass));
    groom.envelope_mass.push_back(static_cast<float>(w.mass_share * mass / w.points));
}

void add_skeleton_springs(const SingleWisp& w, std::uint32_t i, Groom& groom) {
    const double l = w.length / w.segments, weight = w.mass_per_length * w.gravity;
    const double EA = weight * w.length / w.strain;
    groom.stretch_stiffness.push_back(static_cast<float>(EA));
    groom.stretch_damping.push_back(
        static_cast<float>(2 * w.stretch_damping * std::sqrt(EA / l * w.mass_per_length * l)));
    groom.rest_length.push_back(static_cast<float>(l));

    const double EI = weight * std::pow(w.bending_length, 3);
    const double clamped = i == 1 ? 2 : 1;
    const double first_mode =
        w.bending_length > 0 ? 3.516 * std::sqrt(w.gravity / w.bending_length) : 1;
    groom.bend_stiffness.push_back(static_cast<float>(clamped * EI / l));
    groom.bend_damping.push_back(
        static_cast<float>(2 * w.bending_damping / first_mode * clamped * EI / l));
    groom.rest_curvature_u.push_back(0);
    groom.rest_curvature_v.push_back(0);
}

void add_envelope(const SingleWisp& w, std::uint32_t i, Groom& groom) {
    const double mass = i < 2 ? section_mass(w, 2) : section_mass(w, i);
    const double point = w.mass_share * mass / w.points, kept = 1 - w.squeeze;
    const double along = i < 2 ? 0 : static_cast<double>(i - 1) / w.segments;
    const double ramp = 1 + (w.tip_stiffness - 1) * along;
    const double radial = ramp * mass * w.gravity / ((1 / kept - kept) / 2 * w.radius);
    const double ring = w.ring_stiffness * radial;
    groom.radial_stiffness.push_back(static_cast<float>(radial));
    groom.radial_damping.push_back(
        static_cast<float>(2 * w.radial_damping * std::sqrt(radial * point)));
    groom.ring_stiffness.push_back(static_cast<float>(ring));
    groom.ring_damping.push_back(static_cast<float>(2 * w.ring_damping * std::sqrt(ring * point)));
    const double chord = 2 * w.radius * std::sin(std::numbers::pi / w.points);
    for (std::uint32_t k = 0; k < w.points; ++k) {
        groom.radius.push_back(static_cast<float>(w.radius));
        groom.rest_radius.push_back(static_cast<float>(w.radius));
        groom.ring_length.push_back(static_cast<float>(chord));
    }
}

} // namespace

Groom SingleWisp::groom() const {
    Groom groom;
    groom.envelope_points = points;
    const std::uint32_t sections = segments + 2;
    groom.first_section = {0, sections};
    groom.roots.resize(1);
    groom.strands = {1000};
    groom.thickness_power = {static_cast<float>(thickness_power)};
    for (std::uint32_t i = 0; i < sections; ++i) {
        const double along = length / segments * (static_cast<double>(i) - 1);
        groom.position.emplace_back(along * direction);
        add_masses(*this, i, groom);
        add_skeleton_springs(*this, i, groom);
        add_envelope(*this, i, groom);
    }
    return groom;
}

Wisp SingleWisp::wisp() const {
    Wisp wisp = Hair(groom()).wisps.front();
    wisp.u0 = across;
    return wisp;
}

Root still_root(const Wisp& wisp) {
    return {wisp.x[0], wisp.x[1], {}, {}, wisp.u0};
}

Wisp settled(Wisp wisp, const Surroundings& surroundings, double h, double seconds) {
    const Root root = still_root(wisp);
    for (double t = 0; t < seconds; t += h)
        step(wisp, root, root, surroundings, h);
    return wisp;
}

} // namespace mane::reference
