#include "groom/attach.h"
#include "groom/balance.h"
#include "groom/material.h"
#include "groom/rest.h"
#include "groom/shape.h"
#include "mane/error.h"
#include "mane/style.h"

#include <cmath>
#include <string>

namespace mane {
namespace {

void check(const WispDesign& wisp, std::uint32_t points, const Mesh& wearer) {
    const std::size_t sections = wisp.position.size();
    if (sections < 3)
        throw InputError(std::to_string(sections) +
                         " sections; expected at least 3: x0, x1 and one simulated");
    if (wisp.envelope.points < 3 || wisp.envelope.points != points)
        throw InputError("envelope.points is " + std::to_string(wisp.envelope.points) +
                         "; expected at least 3 and the same for all wisps");
    if (wisp.radius.size() != sections * points)
        throw InputError(std::to_string(wisp.radius.size()) + " radii; expected " +
                         std::to_string(sections * points) +
                         ", one per section and envelope point");
    if (wisp.triangle >= wearer.triangles.size())
        throw InputError("rooted in triangle " + std::to_string(wisp.triangle) +
                         "; the wearer has " + std::to_string(wearer.triangles.size()));
    for (std::size_t i = 0; i < wisp.radius.size(); ++i)
        if (!(wisp.radius[i] > 0) || !std::isfinite(wisp.radius[i]))
            throw InputError("section " + std::to_string(i / points) + ": radius " +
                             std::to_string(wisp.radius[i]) + " m; expected over 0");
}

void check(const Shape& shape) {
    for (std::size_t i = 0; i < shape.segments(); ++i) {
        if (!(shape.length[i] > 1e-5))
            throw InputError("segment " + std::to_string(i) + " is " +
                             std::to_string(shape.length[i]) + " m long; expected over 0.00001 m");
        if (i > 0 && dot(shape.tangent[i - 1], shape.tangent[i]) < -0.99)
            throw InputError("section " + std::to_string(i) +
                             ": a fold; expected bends under 170 degrees");
    }
    if (!(length(shape.u[0]) > 0.5))
        throw InputError("first_axis is along the wisp; expected across it");
}

WispRoot attached(const WispDesign& wisp, const Shape& shape, const Mesh& wearer) {
    const TriangleFrame frame = triangle_frame(wearer, wisp.triangle, wisp.barycentric);
    return {wisp.triangle, wisp.barycentric, Vec3(frame.inward(shape.position[0] - frame.origin)),
            Vec3(frame.inward(shape.position[1] - frame.origin)), Vec3(frame.inward(shape.u[0]))};
}

void append(std::vector<float>& to, const std::vector<double>& values) {
    for (double v : values)
        to.push_back(static_cast<float>(v));
}

// One number per segment; the tip has none of its own.
void append_segments(std::vector<float>& to, std::vector<double> values) {
    values.push_back(0);
    append(to, values);
}

void append(Groom& groom, const WispDesign& wisp, const Material& m, const Rest& rest) {
    groom.strands.push_back(wisp.strands);
    groom.thickness_power.push_back(wisp.skeleton.thickness_power);
    groom.position.insert(groom.position.end(), wisp.position.begin(), wisp.position.end());
    groom.radius.insert(groom.radius.end(), wisp.radius.begin(), wisp.radius.end());
    append(groom.skeleton_mass, m.skeleton_mass);
    append(groom.envelope_mass, m.envelope_mass);

    const std::size_t segments = wisp.position.size() - 1;
    std::vector<double> stretch(segments, m.stretch_stiffness),
        damping(segments, m.stretch_damping);
    stretch[0] = damping[0] = 0; // kinematic
    append_segments(groom.stretch_stiffness, stretch);
    append_segments(groom.stretch_damping, damping);
    append_segments(groom.rest_length, rest.length);
    append(groom.bend_stiffness, rest.bend_stiffness);
    append(groom.bend_damping, rest.bend_damping);
    append(groom.rest_curvature_u, rest.curvature_u);
    append(groom.rest_curvature_v, rest.curvature_v);

    append(groom.radial_stiffness, m.radial_stiffness);
    append(groom.radial_damping, m.radial_damping);
    append(groom.ring_stiffness, m.ring_stiffness);
    append(groom.ring_damping, m.ring_damping);
    append(groom.rest_radius, rest.radius);
    append(groom.ring_length, rest.ring_length);
}

void add_wisp(Groom& groom, const WispDesign& wisp, const Mesh& wearer, const Vec3d& gravity) {
    check(wisp, groom.envelope_points, wearer);
    const std::vector<Vec3d> position(wisp.position.begin(), wisp.position.end());
    const Shape shape = make_shape(position, Vec3d(wisp.first_axis));
    check(shape);
    const Material material = make_material(wisp, shape);
    const Rest rest = make_rest(wisp, shape, material, gravity);
    if (!is_stable(shape, material, rest)) {
        const double enough = standing_bending_length(wisp, gravity);
        throw InputError(
            "its weight would make it fall out of the designed shape: skeleton.bending_length is " +
            std::to_string(wisp.skeleton.bending_length) + " m; " +
            (enough > 0 ? std::to_string(enough) + " m would do" : "no other value would do"));
    }
    groom.roots.push_back(attached(wisp, shape, wearer));
    append(groom, wisp, material, rest);
    groom.first_section.push_back(static_cast<std::uint32_t>(groom.position.size()));
}

} // namespace

Groom make_groom(std::span<const WispDesign> wisps, const Mesh& wearer, const Vec3& gravity) {
    Groom groom;
    if (!wisps.empty())
        groom.envelope_points = wisps.front().envelope.points;
    groom.first_section.push_back(0);
    for (std::size_t w = 0; w < wisps.size(); ++w) {
        try {
            add_wisp(groom, wisps[w], wearer, Vec3d(gravity));
        } catch (const InputError& e) {
            throw InputError("wisp " + std::to_string(w) + ": " + e.what());
        }
    }
    return groom;
}

} // namespace mane
