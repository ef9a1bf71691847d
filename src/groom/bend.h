#pragma once

#include "base/functions.h"
#include "mane/vec.h"

#include <cmath>

namespace mane {

/// The bend between two unit tangents (docs/model.md, "Bending"): w = b − a and the three functions
/// of its length.
struct Bend {
    Vec3d w;      ///< b − a
    double g = 1; ///< θ / (2 sin(θ/2)): g w has the length of the bend angle θ
    double q = 1; ///< (θ/2) cot(θ/2)
    double h = 0; ///< (1 − q) / |w|²
};

inline Bend bend_between(const Vec3d& a, const Vec3d& b) {
    const Vec3d w = b - a;
    const double y = dot(w, w) / 4; // sin²(θ/2)
    if (y < 1e-3) {                 // 1 − q and θ/2 over its sine lose digits here: their series
        const double h =
            1.0 / 3 + y * (2.0 / 15 + y * (8.0 / 105 + y * (16.0 / 315 + y * 128 / 3465)));
        const double g =
            1 +
            y * (1.0 / 6 + y * (3.0 / 40 + y * (5.0 / 112 + y * (35.0 / 1152 + y * 63 / 2816))));
        return {w, g, 1 - y * h, h / 4};
    }
    const double sine_half = std::sqrt(y), cosine_half = std::sqrt(std::fmax(0.0, 1 - y));
    const double g = arc_tangent(sine_half, cosine_half) / sine_half;
    const double q = g * cosine_half;
    return {w, g, q, (1 - q) / (4 * y)};
}

/// D' of docs/model.md: what the bending moment is proportional to when the curvature is D away
/// from rest.
inline Vec3d bend_map(const Bend& b, const Vec3d& d) {
    return d * b.q + b.w * (b.h * dot(d, b.w));
}

/// The twist is carried in full through bends of up to 150° (docs/model.md, "Twist"): the least
/// cosine of half of it, and the least 1 + cosine.
inline constexpr double kLeastHalfCosine = 0.25881905, kLeastOnePlusCosine = 0.13397460;

/// β of docs/model.md, "Twist": the frame carried from normal `a` to normal `b` turns about the
/// curve by −β·(δa + δb) when they move.
inline Vec3d holonomy_gradient(const Vec3d& a, const Vec3d& b) {
    return cross(a, b) / std::fmax(1 + dot(a, b), kLeastOnePlusCosine);
}

} // namespace mane
