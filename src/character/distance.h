#pragma once

#include "mane/vec.h"

#include <algorithm>
#include <cmath>

namespace mane {

// Signed distances to simple shapes, negative inside, and smooth unions of them. Exact operations
// only (M39).

inline double clamp01(double x) {
    return std::clamp(x, 0.0, 1.0);
}

inline double ball(const Vec3d& p, const Vec3d& centre, double radius) {
    return length(p - centre) - radius;
}

// A bound of the distance that is exact to first order at the surface.
inline double ellipsoid(const Vec3d& p, const Vec3d& centre, const Vec3d& radii) {
    const Vec3d d = p - centre;
    const Vec3d u{d.x / radii.x, d.y / radii.y, d.z / radii.z};
    const Vec3d g{u.x / radii.x, u.y / radii.y, u.z / radii.z};
    const double size = length(u), slope = length(g);
    return slope > 1e-9 ? size * (size - 1) / slope : -std::min({radii.x, radii.y, radii.z});
}

// A ball that travels from a to b while its radius changes linearly.
inline double cone(const Vec3d& p, const Vec3d& a, double radius_a, const Vec3d& b,
                   double radius_b) {
    const Vec3d axis = b - a;
    const double s = clamp01(dot(p - a, axis) / dot(axis, axis));
    return length(p - a - axis * s) - (radius_a + (radius_b - radius_a) * s);
}

// The lesser of both with the crease between them filled over the width k: cubic, so that curvature
// is continuous.
inline double smooth_union(double a, double b, double k) {
    const double h = std::max(k - std::fabs(a - b), 0.0) / k;
    return std::min(a, b) - h * h * h * k / 6;
}
inline double smooth_intersection(double a, double b, double k) {
    return -smooth_union(-a, -b, k);
}
inline double smooth_difference(double a, double cut, double k) {
    return smooth_intersection(a, -cut, k);
}

} // namespace mane
