#include "character/posed_surface.h"

#include "character/box_tests.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

Triangle in_double(const std::array<Vec3, 3>& corners) {
    return {Vec3d(corners[0]), Vec3d(corners[1]), Vec3d(corners[2])};
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

namespace {

/// The nearest place found so far, and what rules out most triangles before their own nearest place
/// is worked out: those wholly under the plane through the place across the way to it. All of that
/// side is farther.
class NearestSoFar {
  public:
    NearestSoFar(const Vec3d& p, double radius, const PosedSurface::Accept& accept)
        : p_(p), accept_(accept) {
        set_limit(radius * radius);
    }

    const std::optional<SurfacePlace>& place() const { return best_; }
    float limit_of_boxes() const { return limit_of_boxes_; }

    void look_at(std::uint32_t t, const Triangle& corners) {
        if (best_ && under_plane(corners))
            return;
        const SurfacePlace candidate{t, closest_on_triangle(p_, corners)};
        if (candidate.closest.squared > limit_)
            return;
        if (best_ && candidate.closest.squared == limit_ && t >= best_->triangle)
            return;
        if (accept_ && !accept_(candidate))
            return;
        take(candidate);
    }

  private:
    static constexpr double kRounding = 1e-9; // [m] far over that of distances in double

    bool under_plane(const Triangle& t) const {
        return dot(t.a - p_, away_) < plane_ && dot(t.b - p_, away_) < plane_ &&
               dot(t.c - p_, away_) < plane_;
    }
    void take(const SurfacePlace& candidate) {
        best_ = candidate;
        set_limit(candidate.closest.squared);
        away_ = normalized(p_ - candidate.closest.point);
        plane_ = -std::sqrt(limit_) - kRounding;
    }
    void set_limit(double squared) {
        limit_ = squared;
        limit_of_boxes_ = BoxDistances::at_least(squared);
    }

    Vec3d p_;
    const PosedSurface::Accept& accept_;
    std::optional<SurfacePlace> best_;
    double limit_ = 0;
    float limit_of_boxes_ = 0;
    Vec3d away_; // unit, from the place to the point
    double plane_ = 0;
};

} // namespace

/// Goes through the boxes of every node that look_into(node) tells to look into, and calls
/// visit(i, box) for the triangles there, i their place in the tree's order, until it returns
/// false.
template <typename LookInto, typename Visit>
void PosedSurface::walk(LookInto&& look_into, Visit&& visit) const {
    const auto nodes = tree_.nodes();
    if (nodes.empty())
        return;
    std::array<std::uint32_t, TriangleTree::kDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const TriangleTree::Node& node = nodes[stack[--depth]];
        for (std::size_t box : Those(look_into(node))) {
            const std::uint32_t first = node.first[box], last = first + node.count[box];
            for (std::uint32_t i = first; i < last; ++i) {
                if (!visit(i, box))
                    return;
            }
            if (first == last) {
                stack[depth++] = first;
                __builtin_prefetch(&nodes[first]);
            }
        }
    }
}

std::optional<SurfacePlace> PosedSurface::nearest(const Vec3d& p, double radius,
                                                  const Accept& accept, std::uint32_t guess) const {
    NearestSoFar best(p, radius, accept);
    if (guess < triangles_.size())
        best.look_at(guess, triangle(guess));

    const auto nodes = tree_.nodes();
    if (nodes.empty())
        return best.place();
    const BoxDistances distances(p);
    struct Entry {
        std::uint32_t first, count;
        float squared;
    };
    std::array<Entry, TriangleTree::kDepth> stack;
    std::size_t depth = 0;
    stack[depth++] = {};
    while (depth > 0) {
        const Entry entry = stack[--depth];
        if (entry.squared > best.limit_of_boxes())
            continue;
        for (std::uint32_t i = entry.first; i < entry.first + entry.count; ++i)
            best.look_at(tree_.order()[i], in_double(corners_[i]));
        if (entry.count > 0)
            continue;
        const TriangleTree::Node& node = nodes[entry.first];
        const auto squared = distances.squared(node);
        // sorted in, the nearest on top
        const std::size_t bottom = depth;
        for (std::size_t box : Those(squared <= best.limit_of_boxes())) {
            std::size_t place = depth++;
            for (; place > bottom && stack[place - 1].squared < squared[box]; --place)
                stack[place] = stack[place - 1];
            stack[place] = {node.first[box], node.count[box], squared[box]};
        }
    }
    return best.place();
}

void PosedSurface::within(const Vec3d& p, double radius, std::vector<SurfacePlace>& places) const {
    places.clear();
    const double limit = radius * radius;
    const float limit_of_boxes = BoxDistances::at_least(limit);
    const BoxDistances distances(p);
    walk([&](const auto& node) { return distances.squared(node) <= limit_of_boxes; },
         [&](std::uint32_t i, std::size_t) {
             const SurfacePlace place{tree_.order()[i],
                                      closest_on_triangle(p, in_double(corners_[i]))};
             if (place.closest.squared <= limit)
                 places.push_back(place);
             return true;
         });
    std::sort(places.begin(), places.end(),
              [](const SurfacePlace& a, const SurfacePlace& b) { return a.triangle < b.triangle; });
}

/// Calls visit(triangle, hit) for the triangles that the line from `origin` along `direction`
/// crosses, until it returns false. The line is cut at `end` only as far as whole boxes go: hits
/// beyond it may come too.
template <typename Visit> void PosedSurface::along(const Vec3d& origin, const Vec3d& direction,
                                                   double end, Visit&& visit) const {
    const LineCrossing line(origin, direction);
    const BoxCrossings crossings(origin, direction, end);
    walk([&](const auto& node) { return crossings.apart(node) <= 0; },
         [&](std::uint32_t i, std::size_t) {
             const LineCrossing::Hit hit = line.cross(in_double(corners_[i]));
             return hit.sign == 0 || visit(tree_.order()[i], hit);
         });
}

void PosedSurface::crossings(const Vec3d& a, const Vec3d& b, std::vector<Crossing>& found) const {
    found.clear();
    if (a == b)
        return;
    along(a, b - a, 1, [&](std::uint32_t triangle, const LineCrossing::Hit& hit) {
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
    along(a, b - a, 1, [&](std::uint32_t, const LineCrossing::Hit& hit) {
        any = hit.at >= 0 && hit.at < 1;
        return !any;
    });
    return any;
}

float PosedSurface::roof(const BoxHeights& heights, float floor, float enough) const {
    float roof = floor;
    Four highest{};
    walk(
        [&](const auto& node) {
            highest = heights.highest(node);
            return highest > roof;
        },
        [&](std::uint32_t i, std::size_t box) {
            roof = std::max(roof, std::min(highest[box], heights.highest(corners_[i])));
            return roof <= enough;
        });
    return roof;
}

bool PosedSurface::outside_bounds(const Vec3d& p) const {
    if (triangles_.empty())
        return true;
    const auto& [low, high] = tree_.bounds();
    return p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y || p.z < low.z ||
           p.z > high.z;
}

int PosedSurface::winding(const Vec3d& p) const {
    if (outside_bounds(p))
        return 0;
    // Out through the nearest side of the box: the shortest way meets the fewest triangles. Any way
    // gives the same sum.
    const Vec3d low(tree_.bounds().low), high(tree_.bounds().high);
    const double way[6] = {p.x - low.x,  high.x - p.x, p.y - low.y,
                           high.y - p.y, p.z - low.z,  high.z - p.z};
    const Vec3d direction[6] = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};
    const auto side = static_cast<std::size_t>(std::min_element(way, way + 6) - way);
    int entered = 0;
    along(p, direction[side], way[side], [&](std::uint32_t, const LineCrossing::Hit& hit) {
        if (hit.at >= 0)
            entered += hit.sign;
        return true;
    });
    return -entered;
}

} // namespace mane
