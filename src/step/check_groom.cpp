#include "step/check_groom.h"

#include "mane/error.h"
#include "model/layout.h"

#include <cmath>
#include <string>

namespace mane {
namespace {

std::string wisp_name(std::size_t w) {
    return "wisp " + std::to_string(w);
}

void expect_entries(const char* name, std::size_t found, std::size_t expected) {
    if (found != expected)
        throw InputError("a groom with " + std::to_string(found) + " entries of " + name +
                         "; expected " + std::to_string(expected));
}

void check_sizes(const Groom& g) {
    const std::size_t wisps = g.wisp_count();
    expect_entries("first_section", g.first_section.size(), wisps + 1);
    expect_entries("strands", g.strands.size(), wisps);
    expect_entries("thickness_power", g.thickness_power.size(), wisps);
    const std::size_t sections = g.first_section.back(), points = sections * g.envelope_points;
    expect_entries("position", g.position.size(), sections);
    const struct {
        const char* name;
        const std::vector<float>& values;
        std::size_t expected;
    } arrays[] = {{"radius", g.radius, points},
                  {"skeleton_mass", g.skeleton_mass, sections},
                  {"envelope_mass", g.envelope_mass, sections},
                  {"stretch_stiffness", g.stretch_stiffness, sections},
                  {"stretch_damping", g.stretch_damping, sections},
                  {"rest_length", g.rest_length, sections},
                  {"bend_stiffness", g.bend_stiffness, sections},
                  {"bend_damping", g.bend_damping, sections},
                  {"rest_curvature_u", g.rest_curvature_u, sections},
                  {"rest_curvature_v", g.rest_curvature_v, sections},
                  {"radial_stiffness", g.radial_stiffness, sections},
                  {"radial_damping", g.radial_damping, sections},
                  {"ring_stiffness", g.ring_stiffness, sections},
                  {"ring_damping", g.ring_damping, sections},
                  {"rest_radius", g.rest_radius, points},
                  {"ring_length", g.ring_length, points}};
    for (const auto& [name, values, expected] : arrays) {
        expect_entries(name, values.size(), expected);
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!std::isfinite(values[i]))
                throw InputError(std::string("a groom whose ") + name + " " + std::to_string(i) +
                                 " is not finite");
    }
}

void check_masses(const Groom& g, std::size_t w) {
    for (std::uint32_t s = g.first_section[w] + 2; s < g.first_section[w + 1]; ++s)
        if (!(g.skeleton_mass[s] > 0) || !(g.envelope_mass[s] > 0))
            throw InputError(wisp_name(w) + ": section " + std::to_string(s - g.first_section[w]) +
                             " has no mass; expected skeleton and envelope masses over 0 kg");
    for (std::uint32_t s = g.first_section[w]; s + 1 < g.first_section[w + 1]; ++s)
        if (!(g.rest_length[s] > 0))
            throw InputError(wisp_name(w) + ": segment " + std::to_string(s - g.first_section[w]) +
                             " has a rest length of " + std::to_string(g.rest_length[s]) +
                             " m; expected over 0");
}

} // namespace

void check_groom(const Groom& groom, const Mesh& wearer) {
    if (groom.wisp_count() == 0)
        throw InputError("a groom of 0 wisps; expected at least 1");
    if (groom.envelope_points < 3 || groom.envelope_points > kMaxEnvelopePoints)
        throw InputError("a groom with " + std::to_string(groom.envelope_points) +
                         " envelope points; expected 3 to " + std::to_string(kMaxEnvelopePoints));
    check_sizes(groom);
    const std::size_t triangles = wearer.triangles.size();
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        if (groom.roots[w].triangle >= triangles)
            throw InputError(wisp_name(w) + " is rooted in triangle " +
                             std::to_string(groom.roots[w].triangle) +
                             "; expected one of the wearer's " + std::to_string(triangles));
        if (groom.first_section[w + 1] < groom.first_section[w] + 3)
            throw InputError(wisp_name(w) + " has " + std::to_string(groom.sections(w)) +
                             " sections; expected at least 3: two on the head and a tip");
        check_masses(groom, w);
    }
}

void check_same_topology(const Groom& now, const Groom& next) {
    if (next.wisp_count() != now.wisp_count())
        throw InputError("a groom of " + std::to_string(next.wisp_count()) +
                         " wisps; expected the world's " + std::to_string(now.wisp_count()));
    if (next.envelope_points != now.envelope_points)
        throw InputError("a groom with " + std::to_string(next.envelope_points) +
                         " envelope points; expected the world's " +
                         std::to_string(now.envelope_points));
    for (std::size_t w = 0; w < now.wisp_count(); ++w) {
        if (next.sections(w) != now.sections(w))
            throw InputError(wisp_name(w) + " has " + std::to_string(next.sections(w)) +
                             " sections; expected the world's " + std::to_string(now.sections(w)));
        if (next.roots[w].triangle != now.roots[w].triangle ||
            next.roots[w].barycentric != now.roots[w].barycentric)
            throw InputError(wisp_name(w) + " is rooted elsewhere; expected the world's root");
    }
}

} // namespace mane
