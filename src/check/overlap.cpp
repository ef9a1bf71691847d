#include "check/overlap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace mane::judge {
namespace {

constexpr double kBoxMargin = 1e-5;      // [m] docs/model.md, as the next two
constexpr double kSmallestRadius = 1e-6; // [m]
constexpr double kTurnedOver = 1e-6;     // |u×v|² of the interpolated axes

bool holds(const Vec3d& low, const Vec3d& high, const Vec3d& p) {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
           p.z <= high.z;
}

/// Half the size of a disc of radius r along an axis that its normal has the component c of.
double disc_extent(double r, double c) {
    return r * std::sqrt(std::max(0.0, 1 - c * c));
}

Vec3d mix(const Vec3d& a, const Vec3d& b, double s) {
    return a * (1 - s) + b * s;
}

} // namespace

Overlaps::Overlaps(const Groom& groom, const HairGeometry& hair) : groom_(groom), hair_(hair) {
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        for (std::uint32_t s = groom.first_section[w] + 1; s + 1 < groom.first_section[w + 1]; ++s)
            segments_.push_back(s);
    for (std::size_t s = 0; s < groom.section_count(); ++s) {
        points_.push_back(hair.section(s).x);
        for (std::uint32_t k = 0; k < hair.points(); ++k)
            points_.push_back(hair.envelope_point(s, k));
    }
    for (const std::uint32_t s : segments_)
        boxes_.push_back(box_of(s));

    std::vector<std::uint32_t> order(segments_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return boxes_[i].low.y; });
    count_.assign(segments_.size(), 0);
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            const std::uint32_t a = order[i], b = order[j];
            if (boxes_[b].low.y > boxes_[a].high.y)
                break;
            if (boxes_[b].low.x > boxes_[a].high.x || boxes_[a].low.x > boxes_[b].high.x ||
                boxes_[b].low.z > boxes_[a].high.z || boxes_[a].low.z > boxes_[b].high.z ||
                share_section(segments_[a], segments_[b]))
                continue;
            if (any_point_inside(segments_[a], b) || any_point_inside(segments_[b], a)) {
                ++count_[a], ++count_[b];
                pairs_.push_back({a, b});
            }
        }
}

Overlaps::Box Overlaps::box_of(std::size_t segment) const {
    Box box;
    for (int end = 0; end < 2; ++end) {
        const Section& at = hair_.section(segment + end);
        const double r = hair_.largest_radius(segment + end);
        const Vec3d e{disc_extent(r, at.n.x) + kBoxMargin, disc_extent(r, at.n.y) + kBoxMargin,
                      disc_extent(r, at.n.z) + kBoxMargin};
        const Vec3d low = at.x - e, high = at.x + e;
        box = end == 0 ? Box{low, high}
                       : Box{{std::min(box.low.x, low.x), std::min(box.low.y, low.y),
                              std::min(box.low.z, low.z)},
                             {std::max(box.high.x, high.x), std::max(box.high.y, high.y),
                              std::max(box.high.z, high.z)}};
    }
    return box;
}

bool Overlaps::share_section(std::uint32_t a, std::uint32_t b) const {
    return (a > b ? a - b : b - a) <= 1 && wisp_of(groom_, a) == wisp_of(groom_, b);
}

bool Overlaps::any_point_inside(std::uint32_t a, std::size_t b_index) const {
    const std::size_t stride = hair_.points() + 1;
    for (std::size_t i = a * stride; i < (a + 2) * stride; ++i)
        if (holds(boxes_[b_index].low, boxes_[b_index].high, points_[i]) &&
            inside(points_[i], b_index))
            return true;
    return false;
}

bool Overlaps::inside(const Vec3d& p, std::size_t segment_index) const {
    const std::uint32_t segment = segments_[segment_index];
    const Section &begin = hair_.section(segment), &end = hair_.section(segment + 1);
    const double h0 = dot(p - begin.x, begin.n), h1 = dot(end.x - p, end.n);
    if (h0 * h1 < 0 || h0 + h1 == 0)
        return false;
    const double s = h0 / (h0 + h1);
    const Vec3d u = mix(begin.u, end.u, s), v = mix(begin.v, end.v, s);
    const Vec3d off = p - mix(begin.x, end.x, s);
    // off = a u + b v in the plane of the two.
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), det = uu * vv - uv * uv;
    if (det <= kTurnedOver)
        return false;
    const double a = (vv * dot(off, u) - uv * dot(off, v)) / det,
                 b = (uu * dot(off, v) - uv * dot(off, u)) / det;
    return depth(a, b, segment, s) <= 1;
}

double Overlaps::depth(double a, double b, std::uint32_t segment, double s) const {
    const std::uint32_t points = hair_.points();
    const double sector = 2 * std::numbers::pi / points;
    const double turned = std::atan2(b, a),
                 angle = turned < 0 ? turned + 2 * std::numbers::pi : turned;
    const std::uint32_t k = std::min(static_cast<std::uint32_t>(angle / sector), points - 1);
    const auto radius = [&](std::uint32_t i) {
        return std::max((1 - s) * hair_.radius(segment, i) + s * hair_.radius(segment + 1, i),
                        kSmallestRadius);
    };
    const double size = std::hypot(a, b) / std::sin(sector);
    const double alpha = size * std::sin((k + 1) * sector - angle) / radius(k),
                 beta = size * std::sin(angle - k * sector) / radius((k + 1) % points);
    return std::sqrt(alpha * alpha + beta * beta + 2 * alpha * beta * std::cos(sector));
}

} // namespace mane::judge
