#pragma once

#include "character/box_tests.h"
#include "character/triangle_geometry.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mane {

/// A place on a surface: a point of one of its triangles.
struct SurfacePlace {
    std::uint32_t triangle = 0;
    ClosestPoint closest;
};
/// Of equally near places that of the lower triangle goes first.
inline bool nearer(const SurfacePlace& a, const SurfacePlace& b) {
    return a.closest.squared != b.closest.squared ? a.closest.squared < b.closest.squared
                                                  : a.triangle < b.triangle;
}

/// A tree and the triangles in its order.
struct SearchedTriangles {
    const TriangleTree& tree;
    std::span<const TriangleTree::Leaf> leaves;
};

/// The searches that go through many boxes and triangles, compiled once per instruction set. What
/// they find does not depend on it: closest points are those of closest_on_triangle() to the bit.
struct SurfaceSearch {
    /// The nearest place within `radius`; of equally near triangles the lowest.
    std::optional<SurfacePlace> (*nearest)(const SearchedTriangles& in, const Vec3d& p,
                                           double radius);
    /// The nearest places of all triangles within `radius`, in the tree's order.
    void (*within)(const SearchedTriangles& in, const Vec3d& p, double radius,
                   std::vector<SurfacePlace>& places);
    /// Calls visit(context, i) for triangles that the line may cross, i their place in the tree's
    /// order, until it returns false.
    void (*along)(const SearchedTriangles& in, const BoxCrossings& line, void* context,
                  bool (*visit)(void* context, std::uint32_t i));
    /// Of all triangles.
    void (*areas)(std::span<const TriangleTree::Leaf> leaves, std::span<TriangleTree::Areas> areas);
    /// See PosedSurface::roof.
    float (*roof)(const SearchedTriangles& in, const BoxHeights& heights, float floor,
                  float enough);
    float (*roof_in_ball)(const SearchedTriangles& in, const BallHeights& heights, float floor,
                          float enough);
};
/// For an instruction set by name, or the machine's best for "".
SurfaceSearch surface_search_for(const std::string& instruction_set);

} // namespace mane
