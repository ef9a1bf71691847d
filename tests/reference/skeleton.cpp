/// §3.2: the skeleton, a chain of point-masses joined by damped springs that resist stretching and
/// bending.

#include "reference/twin.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mane::reference {

double segment_length(const Wisp& wisp, std::size_t i) {
    return std::max(length(wisp.x[i + 1] - wisp.x[i]), 1e-6);
}

Vec3d segment_direction(const Wisp& wisp, std::size_t i) {
    return (wisp.x[i + 1] - wisp.x[i]) / segment_length(wisp, i);
}

namespace {

/// M1: "point-masses linked by linear damped springs". Segment 0 is not simulated.
void add_stretching(const Wisp& wisp, std::vector<Vec3d>& force) {
    for (std::size_t i = 1; i + 1 < wisp.sections(); ++i) {
        const Vec3d t = segment_direction(wisp, i);
        const double strain = segment_length(wisp, i) / wisp.rest_length[i] - 1;
        const double speed = dot(wisp.v[i + 1] - wisp.v[i], t);
        const double tension = wisp.stretch_stiffness[i] * strain + wisp.stretch_damping[i] * speed;
        force[i] += tension * t;
        force[i + 1] -= tension * t;
    }
}

/// The bend at a joint: w joins the tips of the two directions, and is across the section's normal.
struct Bend {
    Vec3d w;
    double y; ///< sin²(θ/2)
    double G; ///< θ / |w|
    double q; ///< (θ/2) cot(θ/2)
    double H; ///< (1 − q) / 4y
};

Bend bend_at(const Wisp& wisp, std::size_t i) {
    const Vec3d w = segment_direction(wisp, i) - segment_direction(wisp, i - 1);
    const double y = std::min(dot(w, w) / 4, 1.0);
    const bool straight = y < 1e-8; // 0/0; the first terms of the series are exact to 1e-9 there
    const double half_sine = std::sqrt(y);
    const double G = straight ? 1 + y / 6 : std::asin(half_sine) / half_sine;
    const double q = G * std::sqrt(1 - y);
    const double H = straight ? 1.0 / 12 : (1 - q) / (4 * y);
    return {w, y, G, q, H};
}

Curvature curvature_in(const Bend& bend, const SectionFrame& frame) {
    return {bend.G * dot(bend.w, frame.u), bend.G * dot(bend.w, frame.v)};
}

/// Angular velocity of a segment, without its spin.
Vec3d turning(const Wisp& wisp, std::size_t j) {
    return cross(segment_direction(wisp, j), wisp.v[j + 1] - wisp.v[j]) / segment_length(wisp, j);
}

/// M2: the moment that works against a rotation of segment i relative to segment i−1. The elastic
/// part is the gradient of ½ k |κ − κ⁰|².
Vec3d bending_moment(const Wisp& wisp, const SectionFrame& frame, std::size_t i) {
    const Bend bend = bend_at(wisp, i);
    const Curvature kappa = curvature_in(bend, frame);
    const Vec3d D = (kappa.u - wisp.rest_curvature_u[i]) * frame.u +
                    (kappa.v - wisp.rest_curvature_v[i]) * frame.v;
    const Vec3d elastic = bend.q * D + bend.H * dot(D, bend.w) * bend.w;

    const Vec3d spin = turning(wisp, i) - turning(wisp, i - 1);
    const Vec3d bending_rate = spin - frame.n * dot(frame.n, spin);
    return bend_stiffness(wisp, i) * cross(frame.n, elastic) + wisp.bend_damping[i] * bending_rate;
}

/// A moment on a segment is a couple of forces at its two ends.
void add_couple(const Wisp& wisp, std::size_t segment, const Vec3d& moment,
                std::vector<Vec3d>& force) {
    const Vec3d f = cross(moment, segment_direction(wisp, segment)) / segment_length(wisp, segment);
    force[segment + 1] += f;
    force[segment] -= f;
}

void add_bending(const Wisp& wisp, std::vector<Vec3d>& force) {
    const std::vector<SectionFrame> frames = section_frames(wisp);
    for (std::size_t i = 1; i + 1 < wisp.sections(); ++i) {
        const Vec3d moment = bending_moment(wisp, frames[i], i);
        add_couple(wisp, i, -moment, force);
        add_couple(wisp, i - 1, moment, force);
    }
}

/// Least cosines of a half bend, and of a whole one, that the twist is carried through in full: of
/// 150°. At 180° the frames have no limit.
constexpr double kLeastHalfCosine = 0.25881905, kLeastOnePlusCosine = 0.13397460;

/// How the frame carried from normal `a` to normal `b` turns about the curve when they move:
/// −β·(δa + δb), the change of the solid angle that the normals sweep.
Vec3d holonomy_gradient(const Vec3d& a, const Vec3d& b) {
    return cross(a, b) / std::max(1 + dot(a, b), kLeastOnePlusCosine);
}

/// M2, ours: what joint i's rest bend does to a turn of its frame about the curve, the slope of
/// ½ k |κ − κ⁰|².
double twist_moment(const Wisp& wisp, const SectionFrame& frame, std::size_t i) {
    const Curvature kappa = curvature_in(bend_at(wisp, i), frame);
    return bend_stiffness(wisp, i) *
           (wisp.rest_curvature_v[i] * kappa.u - wisp.rest_curvature_u[i] * kappa.v);
}

/// A joint's frame is carried along the curve, so a section that turns its normal turns the rest
/// bends of all joints from there to the tip. The wisp has no twist of its own (M4): it hands their
/// moments on toward the root. At the joint itself, the two segments turn in a frame that stays.
void add_twisting(const Wisp& wisp, std::vector<Vec3d>& force) {
    const std::vector<SectionFrame> frames = section_frames(wisp);
    const std::size_t tip = wisp.sections() - 1;
    std::vector<double> twist(tip + 1);
    for (std::size_t i = tip; i-- > 1;)
        twist[i] = twist[i + 1] + twist_moment(wisp, frames[i], i);
    for (std::size_t i = 1; i < tip; ++i) {
        const Vec3d& n = frames[i].n;
        const Vec3d slope = -twist[i] * holonomy_gradient(frames[i - 1].n, n) -
                            twist[i + 1] * holonomy_gradient(n, frames[i + 1].n);
        for (const std::size_t segment : {i - 1, i}) {
            const Vec3d t = segment_direction(wisp, segment);
            const Vec3d carried = slope / (2 * std::max(dot(n, t), kLeastHalfCosine));
            add_couple(wisp, segment, cross(carried, t) + (twist[i] - twist[i + 1]) / 2 * n, force);
        }
    }
}

double mean(const Ring& ring) {
    return std::accumulate(ring.begin(), ring.end(), 0.0) / static_cast<double>(ring.size());
}

} // namespace

Curvature curvature(const Wisp& wisp, std::size_t i) {
    return curvature_in(bend_at(wisp, i), section_frames(wisp)[i]);
}

/// M3: "a certain resistance to bending, depending of the wisp's thickness".
double bend_stiffness(const Wisp& wisp, std::size_t i) {
    const double ratio = mean(wisp.r[i]) / mean(wisp.design_radius[i]);
    const double factor = std::pow(ratio, wisp.thickness_power);
    return wisp.bend_stiffness[i] * std::clamp(factor, 0.25, 4.0);
}

std::vector<Vec3d> skeleton_forces(const Wisp& wisp) {
    std::vector<Vec3d> force(wisp.sections());
    add_stretching(wisp, force);
    add_bending(wisp, force);
    add_twisting(wisp, force);
    return force;
}

} // namespace mane::reference
