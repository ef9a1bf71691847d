#include "character/triangle_geometry.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mane {
namespace {

double component(const Vec3d& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

ClosestPoint at(const Vec3d& p, const Triangle& t, const Vec3d& bary) {
    ClosestPoint closest;
    closest.barycentric = bary;
    closest.point = t.a * bary.x + t.b * bary.y + t.c * bary.z;
    const Vec3d gap = p - closest.point;
    closest.squared = dot(gap, gap);
    return closest;
}

} // namespace

// Ericson, Real-Time Collision Detection, 5.1.5: the Voronoi regions of corners and edges in turn.
ClosestPoint closest_on_triangle(const Vec3d& p, const Triangle& t) {
    const Vec3d ab = t.b - t.a, ac = t.c - t.a;
    const Vec3d ap = p - t.a;
    const double d1 = dot(ab, ap), d2 = dot(ac, ap);
    if (d1 <= 0 && d2 <= 0)
        return at(p, t, {1, 0, 0});
    const Vec3d bp = p - t.b;
    const double d3 = dot(ab, bp), d4 = dot(ac, bp);
    if (d3 >= 0 && d4 <= d3)
        return at(p, t, {0, 1, 0});
    const Vec3d cp = p - t.c;
    const double d5 = dot(ab, cp), d6 = dot(ac, cp);
    if (d6 >= 0 && d5 <= d6)
        return at(p, t, {0, 0, 1});

    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 - d3 > 0) {
        const double s = d1 / (d1 - d3);
        return at(p, t, {1 - s, s, 0});
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 - d6 > 0) {
        const double s = d2 / (d2 - d6);
        return at(p, t, {1 - s, 0, s});
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0 && (d4 - d3) + (d5 - d6) > 0) {
        const double s = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return at(p, t, {0, 1 - s, s});
    }
    const double sum = va + vb + vc;
    if (!(sum > 0))
        return at(p, t, {1, 0, 0}); // a triangle without area, met on none of its edges by rounding
    return at(p, t, {va / sum, vb / sum, vc / sum});
}

LineCrossing::LineCrossing(const Vec3d& origin, const Vec3d& direction) : origin_(origin) {
    const Vec3d size{std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)};
    if (size.x >= size.y && size.x >= size.z)
        z_ = 0;
    else if (size.y >= size.z)
        z_ = 1;
    x_ = (z_ + 1) % 3;
    y_ = (z_ + 2) % 3;
    const double along = component(direction, z_);
    if (along < 0)
        std::swap(x_, y_); // the view along the line keeps its handedness
    per_z_ = 1 / along;
    shear_x_ = component(direction, x_) * per_z_;
    shear_y_ = component(direction, y_) * per_z_;
}

LineCrossing::Seen LineCrossing::see(const Vec3d& p) const {
    const Vec3d d = p - origin_;
    const double z = component(d, z_);
    return {component(d, x_) - shear_x_ * z, component(d, y_) - shear_y_ * z, z * per_z_};
}

LineCrossing::Hit LineCrossing::cross(const Triangle& t) const {
    const Seen s[3] = {see(t.a), see(t.b), see(t.c)};
    int winding = 0;
    for (int i = 0; i < 3; ++i) {
        const Seen &from = s[i], &to = s[(i + 1) % 3];
        if ((from.y < 0) == (to.y < 0))
            continue;
        // Always from the lower to the upper end, whichever triangle asks: the same rounding.
        const Seen &low = from.y < 0 ? from : to, &high = from.y < 0 ? to : from;
        if (low.x * high.y - high.x * low.y > 0)
            winding += from.y < 0 ? 1 : -1;
    }
    if (winding == 0)
        return {};

    const double u = s[1].x * s[2].y - s[2].x * s[1].y;
    const double v = s[2].x * s[0].y - s[0].x * s[2].y;
    const double w = s[0].x * s[1].y - s[1].x * s[0].y;
    const double area = u + v + w;
    const double first = std::min({s[0].at, s[1].at, s[2].at}),
                 last = std::max({s[0].at, s[1].at, s[2].at});
    const double where = area != 0 ? (u * s[0].at + v * s[1].at + w * s[2].at) / area : first;
    // Counter-clockwise as seen by one who looks back along the line: the line leaves through the
    // front.
    return {-winding, std::clamp(where, first, last)};
}

} // namespace mane
