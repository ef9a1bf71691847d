#include "groom/material.h"

#include "base/functions.h"

#include <cmath>
#include <numeric>

namespace mane {
namespace {

double simulated_length(const Shape& shape) {
    return std::accumulate(shape.length.begin() + 1, shape.length.end(), 0.0);
}

// Half of each neighbouring simulated segment: section 0 has none, section 1 and the tip one half.
std::vector<double> section_masses(const Shape& shape, double mass_per_length) {
    std::vector<double> mass(shape.sections(), 0.0);
    for (std::size_t i = 1; i < shape.segments(); ++i) {
        const double half = mass_per_length * shape.length[i] / 2;
        mass[i] += half;
        mass[i + 1] += half;
    }
    return mass;
}

void share_masses(Material& m, const EnvelopeDesc& envelope) {
    const double share = envelope.mass_share;
    for (double mass : m.section_mass) {
        m.skeleton_mass.push_back((1 - share) * mass);
        m.envelope_mass.push_back(share * mass / envelope.points);
    }
}

void make_skeleton(Material& m, const WispDesign& wisp, const Shape& shape,
                   double mass_per_length) {
    const SkeletonDesc& d = wisp.skeleton;
    const double weight = mass_per_length * kStandardGravity * simulated_length(shape);
    m.stretch_stiffness = weight / d.strain;
    m.stretch_damping = 2.0 * d.stretch_damping * std::sqrt(m.stretch_stiffness * mass_per_length);

    const double b = d.bending_length;
    const double root_rigidity = mass_per_length * kStandardGravity * b * b * b;
    for (std::size_t i = 0; i < shape.sections(); ++i) {
        const double thickness = mean_radius(wisp, i) / mean_radius(wisp, 1);
        m.bend_rigidity.push_back(root_rigidity * power(thickness, d.thickness_power));
    }
    m.bend_time = 2.0 * d.bending_damping / (3.516 * std::sqrt(kStandardGravity / b));
}

void make_envelope(Material& m, const WispDesign& wisp, const Shape& shape) {
    const EnvelopeDesc& d = wisp.envelope;
    const double left = 1 - double{d.squeeze};
    const double squeezing_force_share =
        0.5 * (1 / left - left); // Q / (k₀ r⁰) at the radius that `squeeze` leaves
    const double total = simulated_length(shape);
    double from_root = 0;
    for (std::size_t i = 0; i < shape.sections(); ++i) {
        if (i >= 2)
            from_root += shape.length[i - 1];
        const double ramp =
            d.stiffness.root + (double{d.stiffness.tip} - d.stiffness.root) * from_root / total;
        const double k0 = ramp * m.section_mass[i] * kStandardGravity /
                          (squeezing_force_share * mean_radius(wisp, i));
        const double kr = d.ring_stiffness * k0;
        m.radial_stiffness.push_back(k0);
        m.radial_damping.push_back(2.0 * d.damping * std::sqrt(k0 * m.envelope_mass[i]));
        m.ring_stiffness.push_back(kr);
        m.ring_damping.push_back(2.0 * d.ring_damping * std::sqrt(kr * m.envelope_mass[i]));
    }
}

} // namespace

double mean_radius(const WispDesign& wisp, std::size_t section) {
    const std::size_t k = wisp.envelope.points;
    const auto first = wisp.radius.begin() + static_cast<std::ptrdiff_t>(section * k);
    return std::accumulate(first, first + static_cast<std::ptrdiff_t>(k), 0.0) /
           static_cast<double>(k);
}

Material make_material(const WispDesign& wisp, const Shape& shape) {
    const double mass_per_length = double{wisp.skeleton.strand_mass} * wisp.strands;
    Material m;
    m.section_mass = section_masses(shape, mass_per_length);
    share_masses(m, wisp.envelope);
    make_skeleton(m, wisp, shape, mass_per_length);
    make_envelope(m, wisp, shape);
    return m;
}

} // namespace mane
