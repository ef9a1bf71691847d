#pragma once

#include "character/local_places.h"
#include "character/surface_search.h"

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace mane {

/// Where a segment goes through a surface.
struct Crossing {
    std::uint32_t triangle = 0;
    int sign = 0;  ///< +1 entering, −1 leaving
    double at = 0; ///< 0 at the segment's start, 1 at its end
};

/// A closed triangle mesh in one pose, and what may be asked of it. Queries may run in parallel;
/// their answers do not depend on how the triangles are sorted inside.
class PosedSurface {
  public:
    PosedSurface() = default;
    /// `triangles` must be closed and outlive the surface; `rest` (the vertices in the rest pose)
    /// shapes the search.
    PosedSurface(std::span<const std::array<std::uint32_t, 3>> triangles,
                 std::span<const Vec3> rest, const std::string& instruction_set = "");

    /// Takes a new pose; no allocation after the first.
    void pose(std::span<const Vec3> vertices);

    std::span<const Vec3> vertices() const { return vertices_; }
    Triangle triangle(std::uint32_t t) const {
        const auto& corner = triangles_[t];
        return {Vec3d(vertices_[corner[0]]), Vec3d(vertices_[corner[1]]),
                Vec3d(vertices_[corner[2]])};
    }
    /// Along a triangle's normal, outward, and twice as long as its area [m²].
    Vec3d area(std::uint32_t t) const {
        const std::uint32_t place = place_[t];
        return areas_[place / TriangleTree::kBoxes].of(place % TriangleTree::kBoxes);
    }
    /// Its unit normal; zero where it has no area.
    Vec3d normal(std::uint32_t t) const { return normalized(area(t)); }

    /// The place of a triangle that is nearest to `p`.
    SurfacePlace place_on(std::uint32_t t, const Vec3d& p) const {
        return {t, closest_on_triangle(p, triangle(t))};
    }
    /// The place nearest to `p` within `radius` [m]; of equally near triangles the lowest. `guess`:
    /// a triangle that may be near; a good one saves time, any gives the same answer.
    std::optional<SurfacePlace> nearest(const Vec3d& p, double radius,
                                        std::uint32_t guess = kNoGuess) const;
    static constexpr std::uint32_t kNoGuess = 0xffffffffu;
    /// The same among those that `accept` lets count.
    using Accept = std::function<bool(const SurfacePlace&)>;
    std::optional<SurfacePlace> nearest_accepted(const Vec3d& p, double radius,
                                                 const Accept& accept) const;
    /// The nearest place of every triangle within `radius` [m] of `p`, in the tree's order.
    void within(const Vec3d& p, double radius, std::vector<SurfacePlace>& places) const;
    /// Those of them that keep_local() leaves.
    void local(const Vec3d& p, double radius, PlaceRows& rows,
               std::vector<SurfacePlace>& places) const;
    /// All crossings of the segment from `a` to `b`, by rising position, then triangle. Watertight:
    /// see LineCrossing.
    void crossings(const Vec3d& a, const Vec3d& b, std::vector<Crossing>& found) const;
    /// Whether the segment from `a` to `b` goes through any triangle.
    bool crosses(const Vec3d& a, const Vec3d& b) const;

    /// A height that nothing of the surface within a box or a ball is over, not under `floor`. It
    /// is a bound, cheap and not tight; where it is over `enough` it stops short and is none.
    float roof(const BoxHeights& heights, float floor, float enough) const;
    float roof(const BallHeights& heights, float floor, float enough) const;

    /// Its boxes, in this pose.
    const TriangleTree& tree() const { return tree_; }

    /// How many times the surface winds round `p`: a whole number, since the mesh is closed.
    int winding(const Vec3d& p) const;
    /// Whether `p` is inside the union of the surface's parts: winding number ≥ ½ (M33).
    bool inside(const Vec3d& p) const { return winding(p) > 0; }

  private:
    SearchedTriangles searched() const { return {tree_, leaves_}; }
    template <typename Visit>
    void along(const Vec3d& origin, const Vec3d& direction, double end, Visit&& visit) const;
    bool outside_bounds(const Vec3d& p) const;

    SurfaceSearch search_{};
    KeepLocal* keep_local_ = nullptr;
    std::span<const std::array<std::uint32_t, 3>> triangles_;
    TriangleTree tree_;
    std::vector<Vec3> vertices_;
    std::vector<std::uint32_t> place_;         // of each triangle in the tree's order
    AlignedVector<TriangleTree::Leaf> leaves_; // the triangles in the tree's order
    AlignedVector<TriangleTree::Areas> areas_; // theirs
};

} // namespace mane
