#include "check/solid.h"

#include "check/triangle.h"

#include <algorithm>
#include <cmath>

namespace mane::judge {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kBeyond = 1e-7;     // [m] a step over a surface, to see what is there
constexpr double kDepthStep = 0.002; // [m] first radius of a search for the outside

Vec3d lower(const Vec3d& a, const Vec3d& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3d higher(const Vec3d& a, const Vec3d& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

} // namespace

Solid::Solid(const ClosedTopology& topology, std::span<const Vec3> vertices) {
    const std::vector<Vec3d> at = topology.positions(vertices);
    low_ = {kInfinity, kInfinity, kInfinity};
    high_ = -low_;
    for (const auto& t : topology.triangles()) {
        const Vec3d &a = at[t[0]], &b = at[t[1]], &c = at[t[2]];
        const Vec3d low = lower(a, lower(b, c)), high = higher(a, higher(b, c));
        triangles_.push_back({a, b, c, low.y, high.y});
        low_ = lower(low_, low), high_ = higher(high_, high);
    }
    if (triangles_.empty())
        return;
    // About as many cells as triangles.
    const double width = std::max({high_.x - low_.x, high_.z - low_.z, 1e-6});
    cell_ = width / std::ceil(std::sqrt(static_cast<double>(triangles_.size())));
    nx_ = static_cast<int>((high_.x - low_.x) / cell_) + 1;
    nz_ = static_cast<int>((high_.z - low_.z) / cell_) + 1;

    first_.assign(static_cast<std::size_t>(nx_) * nz_ + 1, 0);
    const auto for_cells = [&](const Triangle& t, const auto& visit) {
        const Cells r = cells(lower(t.a, lower(t.b, t.c)), higher(t.a, higher(t.b, t.c)));
        for (int z = r.z0; z <= r.z1; ++z)
            for (int x = r.x0; x <= r.x1; ++x)
                visit(static_cast<std::size_t>(z) * nx_ + x);
    };
    for (const Triangle& t : triangles_)
        for_cells(t, [&](std::size_t cell) { ++first_[cell + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i)
        first_[i] += first_[i - 1];
    listed_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < triangles_.size(); ++i)
        for_cells(triangles_[i], [&](std::size_t cell) { listed_[next[cell]++] = i; });
}

Solid::Cells Solid::cells(const Vec3d& low, const Vec3d& high) const {
    const auto along = [this](double value, double from, int count) {
        return static_cast<int>(std::clamp(std::floor((value - from) / cell_), 0.0, count - 1.0));
    };
    return {along(low.x, low_.x, nx_), along(high.x, low_.x, nx_), along(low.z, low_.z, nz_),
            along(high.z, low_.z, nz_)};
}

/// All triangles that may reach into a box, some more than once.
template <typename Visit>
void Solid::visit_near(const Vec3d& low, const Vec3d& high, const Visit& visit) const {
    if (triangles_.empty() || high.x < low_.x || low.x > high_.x || high.z < low_.z ||
        low.z > high_.z)
        return;
    const Cells r = cells(low, high);
    for (int z = r.z0; z <= r.z1; ++z)
        for (int x = r.x0; x <= r.x1; ++x) {
            const std::size_t cell = static_cast<std::size_t>(z) * nx_ + x;
            for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
                const Triangle& t = triangles_[listed_[i]];
                if (t.low <= high.y && t.high >= low.y)
                    visit(t);
            }
        }
}

int Solid::winding(const Vec3d& p) const {
    if (p.y < low_.y || p.y > high_.y) // closed: nothing winds round a point beside its box
        return 0;
    int sum = 0;
    visit_near(p, {p.x, kInfinity, p.z}, [&](const Triangle& t) {
        const int passes = vertical_passes(p, t.a, t.b, t.c);
        if (passes != 0 && (t.low > p.y || height_over(p, t.a, t.b, t.c) > p.y))
            sum += passes;
    });
    return sum;
}

double Solid::depth_within(const Vec3d& p, double limit) const {
    const Vec3d reach{limit, limit, limit};
    double best = kInfinity;
    visit_near(p - reach, p + reach, [&](const Triangle& t) {
        const Vec3d q = nearest_in_triangle(p, t.a, t.b, t.c);
        const double distance = length(q - p);
        if (distance > limit || distance >= best)
            return;
        const Vec3d outward = normalized(cross(t.b - t.a, t.c - t.a));
        if (!contains(q + outward * kBeyond))
            best = distance;
    });
    return best;
}

double Solid::depth(const Vec3d& p, double limit) const {
    const double largest = length(high_ - low_);
    for (double radius = std::min(kDepthStep, limit);; radius *= 2) {
        const double found = depth_within(p, std::min(radius, limit));
        if (found < kInfinity || radius >= limit || radius > largest)
            return found;
    }
}

bool Solid::meets(const Vec3d& a, const Vec3d& b) const {
    bool met = contains(a) || contains(b);
    visit_near(lower(a, b), higher(a, b),
               [&](const Triangle& t) { met = met || line_meets_triangle(a, b, t.a, t.b, t.c); });
    return met;
}

} // namespace mane::judge
