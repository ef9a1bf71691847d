#include "character/posed_surface.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

Triangle in_double(const std::array<Vec3, 3>& corners) {
    return {Vec3d(corners[0]), Vec3d(corners[1]), Vec3d(corners[2])};
}

} // namespace

PosedSurface::PosedSurface(std::span<const std::array<std::uint32_t, 3>> triangles,
                           std::span<const Vec3> rest, const std::string& instruction_set)
    : search_(surface_search_for(instruction_set)), keep_local_(keep_local_for(instruction_set)),
      triangles_(triangles), tree_(triangles, rest), place_(triangles.size()),
      leaves_((triangles.size() + TriangleTree::kBoxes - 1) / TriangleTree::kBoxes),
      areas_(leaves_.size()) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        place_[tree_.order()[i]] = i;
    pose(rest);
}

void PosedSurface::pose(std::span<const Vec3> vertices) {
    vertices_.assign(vertices.begin(), vertices.end());
    const auto order = tree_.order();
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto& t = triangles_[order[i]];
        for (std::size_t c = 0; c < 3; ++c)
            leaves_[i / TriangleTree::kBoxes].set(i % TriangleTree::kBoxes, c, vertices[t[c]]);
    }
    tree_.refit(leaves_);
    search_.areas(leaves_, areas_);
}

std::optional<SurfacePlace> PosedSurface::nearest(const Vec3d& p, double radius,
                                                  std::uint32_t guess) const {
    if (guess < triangles_.size()) {
        const double squared = place_on(guess, p).closest.squared;
        radius = std::min(radius, std::sqrt(squared) * (1 + 1e-15));
    }
    return search_.nearest(searched(), p, radius);
}

// In rising distance, from balls that are tried twice as wide as the one before.
std::optional<SurfacePlace> PosedSurface::nearest_accepted(const Vec3d& p, double radius,
                                                           const Accept& accept) const {
    std::vector<SurfacePlace> places;
    double passed = -1;
    for (double ball = std::min(radius, 0.01);; ball = std::min(radius, 2 * ball)) {
        within(p, ball, places);
        std::sort(places.begin(), places.end(), nearer);
        for (const SurfacePlace& place : places) {
            if (place.closest.squared > passed && accept(place))
                return place;
        }
        if (ball == radius)
            return {};
        passed = ball * ball;
    }
}

void PosedSurface::within(const Vec3d& p, double radius, std::vector<SurfacePlace>& places) const {
    places.clear();
    search_.within(searched(), p, radius, places);
}

void PosedSurface::local(const Vec3d& p, double radius, PlaceRows& rows,
                         std::vector<SurfacePlace>& places) const {
    within(p, radius, places);
    keep_local_(triangles_, rows, places);
}

/// Calls visit(triangle, hit) for the triangles that the line from `origin` along `direction`
/// crosses, until it returns false. The line is cut at `end` only as far as whole boxes go: hits
/// beyond it may come too.
template <typename Visit> void PosedSurface::along(const Vec3d& origin, const Vec3d& direction,
                                                   double end, Visit&& visit) const {
    const LineCrossing line(origin, direction);
    auto look = [&](std::uint32_t i) {
        const LineCrossing::Hit hit = line.cross(
            in_double(leaves_[i / TriangleTree::kBoxes].triangle(i % TriangleTree::kBoxes)));
        return hit.sign == 0 || visit(tree_.order()[i], hit);
    };
    search_.along(
        searched(), BoxCrossings(origin, direction, end), &look,
        [](void* context, std::uint32_t i) { return (*static_cast<decltype(look)*>(context))(i); });
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
    return search_.roof(searched(), heights, floor, enough);
}

float PosedSurface::roof(const BallHeights& heights, float floor, float enough) const {
    return search_.roof_in_ball(searched(), heights, floor, enough);
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
