#include "reference/twin.h"

namespace mane::reference {
namespace {

std::vector<double> section_values(const std::vector<float>& all, std::size_t first,
                                   std::size_t last) {
    return {all.begin() + static_cast<std::ptrdiff_t>(first),
            all.begin() + static_cast<std::ptrdiff_t>(last)};
}

std::vector<Ring> ring_values(const std::vector<float>& all, std::size_t first, std::size_t last,
                              std::size_t k) {
    std::vector<Ring> rings;
    for (std::size_t i = first; i < last; ++i)
        rings.push_back(section_values(all, i * k, (i + 1) * k));
    return rings;
}

Wisp wisp_of(const Groom& groom, std::size_t w) {
    const std::size_t first = groom.first_section[w], last = groom.first_section[w + 1];
    const auto values = [&](const std::vector<float>& all) {
        return section_values(all, first, last);
    };
    const auto rings = [&](const std::vector<float>& all) {
        return ring_values(all, first, last, groom.envelope_points);
    };
    Wisp wisp;
    wisp.thickness_power = static_cast<double>(groom.thickness_power[w]);
    wisp.skeleton_mass = values(groom.skeleton_mass);
    wisp.envelope_mass = values(groom.envelope_mass);
    wisp.stretch_stiffness = values(groom.stretch_stiffness);
    wisp.stretch_damping = values(groom.stretch_damping);
    wisp.rest_length = values(groom.rest_length);
    wisp.bend_stiffness = values(groom.bend_stiffness);
    wisp.bend_damping = values(groom.bend_damping);
    wisp.rest_curvature_u = values(groom.rest_curvature_u);
    wisp.rest_curvature_v = values(groom.rest_curvature_v);
    wisp.radial_stiffness = values(groom.radial_stiffness);
    wisp.radial_damping = values(groom.radial_damping);
    wisp.ring_stiffness = values(groom.ring_stiffness);
    wisp.ring_damping = values(groom.ring_damping);
    wisp.rest_radius = rings(groom.rest_radius);
    wisp.ring_length = rings(groom.ring_length);
    wisp.design_radius = rings(groom.radius);

    wisp.r = wisp.design_radius;
    wisp.r_rate.assign(last - first, Ring(groom.envelope_points, 0.0));
    wisp.v.resize(last - first);
    wisp.air.resize(last - first);
    for (std::size_t i = first; i < last; ++i)
        wisp.x.emplace_back(groom.position[i]);
    return wisp;
}

} // namespace

Hair::Hair(const Groom& groom) {
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        wisps.push_back(wisp_of(groom, w));
}

void set_state(Hair& hair, const Frame& frame) {
    std::size_t section = 0;
    for (std::size_t w = 0; w < hair.wisps.size(); ++w) {
        Wisp& wisp = hair.wisps[w];
        const std::size_t k = wisp.points();
        wisp.u0 = Vec3d(frame.first_axis[w]);
        for (std::size_t i = 0; i < wisp.sections(); ++i, ++section) {
            wisp.x[i] = Vec3d(frame.position[section]);
            wisp.v[i] = Vec3d(frame.velocity[section]);
            wisp.r[i] = section_values(frame.radius, section * k, (section + 1) * k);
            wisp.r_rate[i] = section_values(frame.radius_rate, section * k, (section + 1) * k);
        }
    }
}

} // namespace mane::reference
