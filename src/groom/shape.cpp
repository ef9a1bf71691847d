#include "groom/shape.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr double kShortest = 1e-6; // [m] as the step does: a vanished segment keeps a length

Vec3d bisecting_normal(const Vec3d& before, const Vec3d& after) {
    const Vec3d sum = before + after;
    return length(sum) < 1e-3 ? before : normalized(sum);
}

// The least rotation that takes normal a to normal b, applied to the axis u (M8).
Vec3d carried(const Vec3d& u, const Vec3d& a, const Vec3d& b) {
    const Vec3d turned = u - (a + b) * (dot(u, b) / std::max(1e-6, 1 + dot(a, b)));
    return normalized(turned - b * dot(turned, b));
}

} // namespace

Shape make_shape(std::span<const Vec3d> position, const Vec3d& first_axis) {
    Shape s;
    s.position.assign(position.begin(), position.end());
    const std::size_t n = position.size() - 1;
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3d edge = position[i + 1] - position[i];
        s.length.push_back(std::max(length(edge), kShortest));
        s.tangent.push_back(edge / s.length[i]);
    }
    s.normal.push_back(s.tangent[0]);
    for (std::size_t i = 1; i < n; ++i)
        s.normal.push_back(bisecting_normal(s.tangent[i - 1], s.tangent[i]));
    s.normal.push_back(s.tangent[n - 1]);

    s.u.push_back(normalized(first_axis - s.normal[0] * dot(first_axis, s.normal[0])));
    for (std::size_t i = 1; i <= n; ++i)
        s.u.push_back(carried(s.u[i - 1], s.normal[i - 1], s.normal[i]));
    for (std::size_t i = 0; i <= n; ++i)
        s.v.push_back(cross(s.normal[i], s.u[i]));
    return s;
}

} // namespace mane
