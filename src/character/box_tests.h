#pragma once

#include "character/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mane {

// Which of a node's boxes a query must look into: bounds in single precision, widened by more than
// its rounding, so that no box is left out wrongly. What is found in the boxes is exact. Here is
// what is known beforehand; surface_search.cpp tests sixteen boxes at a time.

/// Several times the rounding of single precision.
inline constexpr float kBoxRounding = 1e-6f;

/// Distances from a point.
struct BoxDistances {
    explicit BoxDistances(const Vec3d& p);
    /// A squared distance in single precision that is not less than `squared`, or the largest: that
    /// far is nothing but the places of a node that hold no box.
    static float at_least(double squared) {
        return std::min(static_cast<float>(squared) * (1 + kBoxRounding),
                        std::numeric_limits<float>::max());
    }

    std::array<float, 3> above, below; ///< the point, widened by the slack
};

/// Heights along a way, of what is within a box that is along the axes.
struct BoxHeights {
    /// `way`: unit, or zero: then all heights are 0.
    BoxHeights(const Vec3& way, const TriangleTree::Box& box);

    static constexpr float kLowest = -1e30f;

    Vec3 along;
    std::array<float, 3> up, down; ///< the way's parts that are positive, and negative
    std::array<float, 3> low, high;
    float slack = 0; ///< more than a height in the box may be off when reckoned in single precision
};

/// The same of what is within a ball.
struct BallHeights : BoxHeights {
    BallHeights(const Vec3& way, const Vec3& centre, float radius)
        : BoxHeights(
              way, {centre - Vec3(radius, radius, radius), centre + Vec3(radius, radius, radius)}),
          distances(Vec3d(centre)),
          squared(BoxDistances::at_least(double(radius) * double(radius))) {}

    BoxDistances distances;
    float squared; ///< radius
};

/// The part of a line from `origin` to `end` times `direction` (not zero) beyond it.
struct BoxCrossings {
    BoxCrossings(const Vec3d& origin, const Vec3d& direction, double end);

    std::array<std::size_t, 3> axis; ///< the last is the largest of the direction
    std::array<float, 3> origin;     ///< along these axes
    std::array<float, 2> shear;
    float first, last; ///< along the last axis
    float slack;
};

} // namespace mane
