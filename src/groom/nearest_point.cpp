#include "groom/nearest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mane {
namespace {

constexpr double kPointsPerCell = 2;

} // namespace

NearestPoint::NearestPoint(std::span<const Vec3d> points) : points_(points.begin(), points.end()) {
    Vec3d high = low_ = points_.front();
    for (const Vec3d& p : points_) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y), std::min(low_.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    // The points lie on a surface: as many cells across as their share of the largest extent.
    const Vec3d extent = high - low_;
    const double longest = std::max({extent.x, extent.y, extent.z, 1e-9});
    size_ = longest / std::ceil(std::sqrt(static_cast<double>(points_.size()) / kPointsPerCell));
    const double sides[3] = {extent.x, extent.y, extent.z};
    for (int axis = 0; axis < 3; ++axis)
        count_[axis] = 1 + static_cast<long>(sides[axis] / size_);

    const auto index = [this](const Cell& c) {
        return static_cast<std::size_t>((c.z * count_[1] + c.y) * count_[0] + c.x);
    };
    cells_.start(static_cast<std::size_t>(count_[0] * count_[1] * count_[2]));
    for (const Vec3d& p : points_)
        cells_.count(index(cell_of(p)));
    order_.resize(cells_.add_up());
    for (std::uint32_t i = 0; i < points_.size(); ++i)
        order_[cells_.next(index(cell_of(points_[i])))] = i;
    cells_.finish();
}

NearestPoint::Cell NearestPoint::cell_of(const Vec3d& p) const {
    const auto along = [this](double x, double low, long count) {
        return std::clamp(static_cast<long>(std::floor((x - low) / size_)), 0L, count - 1);
    };
    return {along(p.x, low_.x, count_[0]), along(p.y, low_.y, count_[1]),
            along(p.z, low_.z, count_[2])};
}

/// The points in the cells that are `away` cells from the middle one, along one axis at least.
template <typename Visit>
void NearestPoint::for_shell(const Cell& middle, long away, Visit&& visit) const {
    const auto from = [away](long c) { return std::max(0L, c - away); };
    const auto to = [away](long c, long count) { return std::min(count - 1, c + away); };
    for (long z = from(middle.z); z <= to(middle.z, count_[2]); ++z)
        for (long y = from(middle.y); y <= to(middle.y, count_[1]); ++y) {
            const bool face = std::abs(z - middle.z) == away || std::abs(y - middle.y) == away;
            const long step = face || away == 0 ? 1 : 2 * away;
            for (long x = face ? from(middle.x) : middle.x - away; x <= to(middle.x, count_[0]);
                 x += step) {
                if (x < 0)
                    continue;
                const auto c = static_cast<std::size_t>((z * count_[1] + y) * count_[0] + x);
                for (std::uint32_t i = cells_.first(c); i < cells_.last(c); ++i)
                    visit(order_[i]);
            }
        }
}

std::size_t NearestPoint::operator()(const Vec3d& p) const {
    const Cell middle = cell_of(p);
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    // Beyond a shell nothing is nearer than the way out of it; outside of all cells that way is
    // longer still.
    const long last = std::max({count_[0], count_[1], count_[2]});
    for (long away = 0; away <= last; ++away) {
        for_shell(middle, away, [&](std::size_t i) {
            const Vec3d way = points_[i] - p;
            const double d = dot(way, way);
            if (d < least || (d == least && i < best))
                least = d, best = i;
        });
        const double clear = static_cast<double>(away) * size_;
        if (least <= clear * clear)
            break;
    }
    return best;
}

} // namespace mane
