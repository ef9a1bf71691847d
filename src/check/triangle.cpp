#include "check/triangle.h"

#include <algorithm>

namespace mane::judge {
namespace {

Vec3d nearest_on_line(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
    const Vec3d e = b - a;
    const double square = dot(e, e);
    return square > 0 ? a + e * std::clamp(dot(p - a, e) / square, 0.0, 1.0) : a;
}

/// Whether, in the ground plan, the edge passes p on the side of +z, and which way along x.
int passes_beyond(const Vec3d& p, const Vec3d& a, const Vec3d& b) {
    if ((a.x <= p.x) == (b.x <= p.x))
        return 0;
    // Both triangles of an edge compute with its ends in the same order.
    const Vec3d &left = a.x < b.x ? a : b, &right = a.x < b.x ? b : a;
    const double z = left.z + (right.z - left.z) * ((p.x - left.x) / (right.x - left.x));
    if (z <= p.z)
        return 0;
    return a.x < b.x ? 1 : -1;
}

} // namespace

Vec3d nearest_in_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d n = cross(b - a, c - a);
    const bool above = dot(cross(b - a, p - a), n) >= 0 && dot(cross(c - b, p - b), n) >= 0 &&
                       dot(cross(a - c, p - c), n) >= 0;
    if (above && dot(n, n) > 0)
        return p - n * (dot(p - a, n) / dot(n, n));
    Vec3d best = nearest_on_line(p, a, b);
    for (const Vec3d& q : {nearest_on_line(p, b, c), nearest_on_line(p, c, a)})
        if (dot(q - p, q - p) < dot(best - p, best - p))
            best = q;
    return best;
}

bool line_meets_triangle(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b,
                         const Vec3d& c) {
    const Vec3d n = cross(b - a, c - a);
    const double from = dot(p - a, n), to = dot(q - a, n);
    if ((from < 0) == (to < 0))
        return false;
    const Vec3d at = p + (q - p) * (from / (from - to));
    return dot(cross(b - a, at - a), n) >= 0 && dot(cross(c - b, at - b), n) >= 0 &&
           dot(cross(a - c, at - c), n) >= 0;
}

int vertical_passes(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return passes_beyond(p, a, b) + passes_beyond(p, b, c) + passes_beyond(p, c, a);
}

double height_over(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d n = cross(b - a, c - a);
    const double low = std::min({a.y, b.y, c.y}), high = std::max({a.y, b.y, c.y});
    if (n.y == 0)
        return low;
    return std::clamp(a.y - (n.x * (p.x - a.x) + n.z * (p.z - a.z)) / n.y, low, high);
}

} // namespace mane::judge
