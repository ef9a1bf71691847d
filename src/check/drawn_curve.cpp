#include "check/drawn_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mane::judge {
namespace {

constexpr double kNoise = 1e-6; // [m] floats at a metre from the origin, through a few additions
constexpr double kOutside =
    -1e-3; // share of a half line by which a point may be in the next sector

Vec3d catmull_rom(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d, double t) {
    return (b * 2.0 + (c - a) * t + (a * 2.0 - b * 5.0 + c * 4.0 - d) * (t * t) +
            (b * 3.0 - a - c * 3.0 + d) * (t * t * t)) *
           0.5;
}

} // namespace

void DrawnSection::place(const Groom& groom, const HairGeometry& hair, std::size_t wisp,
                         double parameter) {
    const std::size_t first = groom.first_section[wisp], last = groom.first_section[wisp + 1] - 1;
    const std::size_t i = first + std::min(static_cast<std::size_t>(parameter), last - first - 1);
    const double t = parameter - static_cast<double>(i - first);
    const std::size_t before = std::max(i, first + 1) - 1, after = std::min(i + 2, last);

    const auto x = [&](std::size_t s) { return hair.section(s).x; };
    centre_ = catmull_rom(x(before), x(i), x(i + 1), x(after), t);
    ends_.resize(hair.points());
    mean_radius_ = 0;
    for (std::uint32_t k = 0; k < hair.points(); ++k) {
        const auto end = [&](std::size_t s) { return hair.half_line(s, k) * hair.radius(s, k); };
        ends_[k] = catmull_rom(end(before), end(i), end(i + 1), end(after), t);
        mean_radius_ += length(ends_[k]) / hair.points();
    }
}

double DrawnSection::outside(const Vec3d& p) const {
    const Vec3d off = p - centre_;
    const double size = length(off), cosine = std::cos(2 * std::numbers::pi / double(ends_.size()));
    double excess = size; // the centre itself is inside, whatever the half lines are
    for (std::size_t k = 0; k < ends_.size(); ++k) {
        const Vec3d &a = ends_[k], &b = ends_[(k + 1) % ends_.size()];
        const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = aa * bb - ab * ab;
        if (!(det > 1e-12 * aa * bb))
            continue; // pressed flat: no area
        const double alpha = (bb * dot(off, a) - ab * dot(off, b)) / det,
                     beta = (aa * dot(off, b) - ab * dot(off, a)) / det;
        if (alpha < kOutside || beta < kOutside)
            continue;
        const double across = length(off - a * alpha - b * beta);
        const double depth = std::sqrt(alpha * alpha + beta * beta + 2 * alpha * beta * cosine);
        const double beyond = depth > 1 ? size * (1 - 1 / depth) : 0;
        excess = std::min(excess, across + beyond);
    }
    if (excess <= kNoise)
        return 0;
    return mean_radius_ > 0 ? (excess - kNoise) / mean_radius_
                            : std::numeric_limits<double>::infinity();
}

} // namespace mane::judge
