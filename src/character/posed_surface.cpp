#include "character/posed_surface.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

Triangle in_double(const std::array<Vec3, 3>& corners) {
    return {Vec3d(corners[0]), Vec3d(corners[1]), Vec3d(corners[2])};
}

/// Squared distance from a point to a box, never more than to any triangle in it, rounding
/// included.
double squared_distance(const Vec3d& p, const TriangleTree::Node& box) {
    const auto gap = [](double x, float low, float high) {
        return std::max({low - x, x - high, 0.0});
    };
    const Vec3d d{gap(p.x, box.low.x, box.high.x), gap(p.y, box.low.y, box.high.y),
                  gap(p.z, box.low.z, box.high.z)};
    return dot(d, d) * (1 - 1e-9) - 1e-18;
}

} // namespace

PosedSurface::PosedSurface(std::span<const std::array<std::uint32_t, 3>> triangles,
                           std::span<const Vec3> rest)
    : triangles_(triangles), tree_(triangles, rest), corners_(triangles.size()) {
    pose(rest);
}

void PosedSurface::pose(std::span<const Vec3> vertices) {
    vertices_.assign(vertices.begin(), vertices.end());
    const auto order = tree_.order();
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto& t = triangles_[order[i]];
        corners_[i] = {vertices[t[0]], vertices[t[1]], vertices[t[2]]};
    }
    tree_.refit(corners_);
}

Triangle PosedSurface::triangle(std::uint32_t t) const {
    const auto& corner = triangles_[t];
    return in_double({vertices_[corner[0]], vertices_[corner[1]], vertices_[corner[2]]});
}

Vec3d PosedSurface::normal(std::uint32_t t) const {
    const Triangle corners = triangle(t);
    return normalized(cross(corners.b - corners.a, corners.c - corners.a));
}

std::optional<SurfacePlace> PosedSurface::nearest(const Vec3d& p, double radius,
                                                  const Accept& accept, std::uint32_t guess) const {
    std::optional<SurfacePlace> best;
    double limit = radius * radius;
    const auto look_at = [&](std::uint32_t t, const Triangle& corners) {
        const SurfacePlace candidate{t, closest_on_triangle(p, corners)};
        if (candidate.closest.squared > limit)
            return;
        if (best && candidate.closest.squared == limit && t >= best->triangle)
            return;
        if (accept && !accept(candidate))
            return;
        best = candidate;
        limit = candidate.closest.squared;
    };
    if (guess < triangles_.size())
        look_at(guess, triangle(guess));

    const auto nodes = tree_.nodes();
    if (nodes.empty())
        return best;
    struct Entry {
        std::uint32_t node;
        double squared;
    };
    std::array<Entry, TriangleTree::kDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = {0, squared_distance(p, nodes[0])};
    while (depth > 0) {
        const Entry entry = stack[--depth];
        if (entry.squared > limit)
            continue;
        const TriangleTree::Node& node = nodes[entry.node];
        for (std::uint32_t i = 0; i < node.count; ++i)
            look_at(tree_.order()[node.next + i], in_double(corners_[node.next + i]));
        if (node.count > 0)
            continue;
        Entry near{entry.node + 1, squared_distance(p, nodes[entry.node + 1])};
        Entry far{node.next, squared_distance(p, nodes[node.next])};
        if (far.squared < near.squared)
            std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
    }
    return best;
}

void PosedSurface::within(const Vec3d& p, double radius, std::vector<SurfacePlace>& places) const {
    places.clear();
    const auto nodes = tree_.nodes();
    if (nodes.empty())
        return;
    const double limit = radius * radius;
    std::array<std::uint32_t, TriangleTree::kDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const TriangleTree::Node& node = nodes[at];
        if (squared_distance(p, node) > limit)
            continue;
        for (std::uint32_t i = node.next; i < node.next + node.count; ++i) {
            const SurfacePlace place{tree_.order()[i],
                                     closest_on_triangle(p, in_double(corners_[i]))};
            if (place.closest.squared <= limit)
                places.push_back(place);
        }
        if (node.count > 0)
            continue;
        stack[depth++] = node.next;
        stack[depth++] = at + 1;
    }
    std::sort(places.begin(), places.end(),
              [](const SurfacePlace& a, const SurfacePlace& b) { return a.triangle < b.triangle; });
}

/// Calls visit(triangle, hit) for the triangles that the line crosses, until it returns false. The
/// line is cut at `end` only as far as whole boxes go: hits beyond it may come too.
template <typename Visit>
void PosedSurface::along(const LineCrossing& line, double end, Visit&& visit) const {
    const auto nodes = tree_.nodes();
    if (nodes.empty())
        return;
    std::array<std::uint32_t, TriangleTree::kDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const std::uint32_t at = stack[--depth];
        const TriangleTree::Node& node = nodes[at];
        if (!line.may_meet(node.low, node.high, end))
            continue;
        for (std::uint32_t i = node.next; i < node.next + node.count; ++i) {
            const LineCrossing::Hit hit = line.cross(in_double(corners_[i]));
            if (hit.sign != 0 && !visit(tree_.order()[i], hit))
                return;
        }
        if (node.count > 0)
            continue;
        stack[depth++] = node.next;
        stack[depth++] = at + 1;
    }
}

void PosedSurface::crossings(const Vec3d& a, const Vec3d& b, std::vector<Crossing>& found) const {
    found.clear();
    if (a == b)
        return;
    along(LineCrossing(a, b - a), 1, [&](std::uint32_t triangle, const LineCrossing::Hit& hit) {
        if (hit.at >= 0 && hit.at < 1)
            found.push_back({triangle, hit.sign, hit.at});
        return true;
    });
    std::sort(found.begin(), found.end(), [](const Crossing& x, const Crossing& y) {
        return x.at != y.at ? x.at < y.at : x.triangle < y.triangle;
    });
}

bool PosedSurface::crosses(const Vec3d& a, const Vec3d& b) const {
    if (a == b)
        return false;
    bool any = false;
    along(LineCrossing(a, b - a), 1, [&](std::uint32_t, const LineCrossing::Hit& hit) {
        any = hit.at >= 0 && hit.at < 1;
        return !any;
    });
    return any;
}

bool PosedSurface::outside_bounds(const Vec3d& p) const {
    const auto nodes = tree_.nodes();
    if (nodes.empty())
        return true;
    const Vec3 &low = nodes[0].low, &high = nodes[0].high;
    return p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y || p.z < low.z ||
           p.z > high.z;
}

int PosedSurface::winding(const Vec3d& p) const {
    if (outside_bounds(p))
        return 0;
    // Out through the nearest side of the box: the shortest way meets the fewest triangles. Any way
    // gives the same sum.
    const Vec3d low(tree_.nodes()[0].low), high(tree_.nodes()[0].high);
    const double way[6] = {p.x - low.x,  high.x - p.x, p.y - low.y,
                           high.y - p.y, p.z - low.z,  high.z - p.z};
    const Vec3d direction[6] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};
    const auto side = static_cast<std::size_t>(std::min_element(way, way + 6) - way);
    int entered = 0;
    along(LineCrossing(p, direction[side]), way[side],
          [&](std::uint32_t, const LineCrossing::Hit& hit) {
              if (hit.at >= 0)
                  entered += hit.sign;
              return true;
          });
    return -entered;
}

} // namespace mane
