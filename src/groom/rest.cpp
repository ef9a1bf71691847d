#include "groom/rest.h"

#include "base/functions.h"
#include "groom/joint.h"
#include "mane/error.h"

#include <cmath>
#include <string>

namespace mane {
namespace {

// The weight that each segment carries: of all sections after it.
std::vector<Vec3d> carried_weight(const Shape& shape, const Material& m, const Vec3d& gravity) {
    std::vector<Vec3d> weight(shape.segments());
    Vec3d below;
    for (std::size_t i = shape.segments(); i-- > 0;) {
        below += gravity * m.section_mass[i + 1];
        weight[i] = below;
    }
    return weight;
}

// EA (l/L − 1) is the weight's part along the segment.
std::vector<double> natural_lengths(const Shape& shape, const Material& m,
                                    const std::vector<Vec3d>& weight) {
    std::vector<double> natural = shape.length;
    for (std::size_t i = 1; i < shape.segments(); ++i) {
        const double stretched = 1 + dot(weight[i], shape.tangent[i]) / m.stretch_stiffness;
        if (stretched < 0.1)
            throw InputError(
                "segment " + std::to_string(i) + " would be pressed to " +
                std::to_string(stretched) +
                " of its length by the weight above it; a smaller skeleton.strain would do");
        natural[i] = shape.length[i] / stretched;
    }
    return natural;
}

// k and c of every joint: a clamped end at the root, half of each neighbour elsewhere.
void make_joints(Rest& rest, const Shape& shape, const Material& m) {
    rest.bend_stiffness.assign(shape.sections(), 0.0);
    rest.bend_damping.assign(shape.sections(), 0.0);
    for (std::size_t i = 1; i < shape.segments(); ++i) {
        const double spacing =
            i == 1 ? rest.length[1] / 2 : (rest.length[i - 1] + rest.length[i]) / 2;
        rest.bend_stiffness[i] = m.bend_rigidity[i] / spacing;
        rest.bend_damping[i] = m.bend_time * rest.bend_stiffness[i];
    }
}

// From the tip to the root: the moments of the two joints of a segment, and the twist handed on
// through them, hold it against the weight that hangs on its end. This is linear in the joint's two
// components off rest.
void make_curvatures(Rest& rest, const Shape& shape, const std::vector<Vec3d>& weight) {
    rest.curvature_u.assign(shape.sections(), 0.0);
    rest.curvature_v.assign(shape.sections(), 0.0);
    Vec3d held_by_next;
    double twist = 0;
    for (std::size_t i = shape.segments() - 1; i >= 1; --i) {
        const Joint joint(shape, i);
        const Vec3d needed = cross(shape.tangent[i], weight[i]) * shape.length[i] - held_by_next;
        const Vec3d off_rest = joint.solve_after(needed - joint.handed_on_after(twist));

        const Vec3d curvature = joint.curvature() - off_rest / rest.bend_stiffness[i];
        rest.curvature_u[i] = dot(curvature, shape.u[i]);
        rest.curvature_v[i] = dot(curvature, shape.v[i]);
        held_by_next = joint.on_before(off_rest) + joint.handed_on_before(twist);
        twist += joint.twist(off_rest);
    }
}

// Radial springs hold the envelope points against the fall that their section does not take part
// in, Q = −m d·g, and ½ k₀ (r⁰²/r − r) = Q is solved for r⁰. Ring springs are unloaded.
void make_envelope(Rest& rest, const WispDesign& wisp, const Shape& shape, const Material& m,
                   const Vec3d& gravity) {
    const std::size_t points = wisp.envelope.points;
    rest.radius.resize(shape.sections() * points);
    rest.ring_length.resize(shape.sections() * points);
    for (std::size_t i = 0; i < shape.sections(); ++i) {
        for (std::size_t k = 0; k < points; ++k) {
            const double angle = 2 * kPi * static_cast<double>(k) / static_cast<double>(points);
            const Vec3d d = shape.u[i] * cosine(angle) + shape.v[i] * sine(angle);
            const double r = wisp.radius[i * points + k],
                         next = wisp.radius[i * points + (k + 1) % points];
            const double k0 = m.radial_stiffness[i];
            const double force = k0 > 0 ? -m.envelope_mass[i] * dot(d, gravity) : 0;
            const double squared = r * r + (k0 > 0 ? 2 * r * force / k0 : 0);
            // ρ = r/r⁰ must stay well over 0.15, where the spring stops stiffening.
            if (squared < 0.04 * r * r || squared > 25 * r * r)
                throw InputError("section " + std::to_string(i) + ": a radius of " +
                                 std::to_string(r) +
                                 " m is too small for its envelope point's weight; a smaller "
                                 "envelope.squeeze would do");
            rest.radius[i * points + k] = std::sqrt(squared);
            const double c = cosine(2 * kPi / static_cast<double>(points));
            rest.ring_length[i * points + k] = std::sqrt(r * r + next * next - 2 * c * r * next);
        }
    }
}

} // namespace

Rest make_rest(const WispDesign& wisp, const Shape& shape, const Material& material,
               const Vec3d& gravity) {
    const std::vector<Vec3d> weight = carried_weight(shape, material, gravity);
    Rest rest;
    rest.length = natural_lengths(shape, material, weight);
    make_joints(rest, shape, material);
    make_curvatures(rest, shape, weight);
    make_envelope(rest, wisp, shape, material, gravity);
    return rest;
}

} // namespace mane
