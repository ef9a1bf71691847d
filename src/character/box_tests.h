#pragma once

#include "character/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mane {

// Which of a node's four boxes a query must look into: bounds in single precision, widened by more
// than its rounding, so that no box is left out wrongly. What is found in the boxes is exact.

/// Several times the rounding of single precision.
inline constexpr float kBoxRounding = 1e-6f;

/// Distances from a point.
class BoxDistances {
  public:
    explicit BoxDistances(const Vec3d& p);
    /// Squared, never more than to any triangle in the box.
    Four squared(const TriangleTree::Node& node) const {
        Four sum{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Four below = node.low[axis] - above_[axis];
            const Four above = below_[axis] - node.high[axis];
            const Four gap = larger(larger(below, above), Four{});
            sum += gap * gap;
        }
        return sum * (1 - kBoxRounding);
    }
    /// A squared distance in single precision that is not less than `squared`.
    static float at_least(double squared) {
        return static_cast<float>(squared) * (1 + kBoxRounding);
    }

  private:
    std::array<Four, 3> above_, below_; // the point, widened by the slack
};

/// Heights along a way, of what is within a box that is along the axes.
class BoxHeights {
  public:
    /// `way`: unit, or zero: then all heights are 0.
    BoxHeights(const Vec3& way, const TriangleTree::Box& box);

    /// Not lower than anything within both boxes; lowest of all where they are apart.
    Four highest(const TriangleTree::Node& node) const {
        Four gap{}, height = Four{} + slack_;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Four low = larger(node.low[axis], low_[axis]),
                       high = smaller(node.high[axis], high_[axis]);
            gap = larger(gap, low - high);
            height += up_[axis] * high + down_[axis] * low;
        }
        return gap > 0 ? Four{} + kLowest : height;
    }
    /// Not lower than the triangle.
    float highest(const std::array<Vec3, 3>& corners) const {
        const Vec3d way(along_);
        const double height = std::max({dot(way, Vec3d(corners[0])), dot(way, Vec3d(corners[1])),
                                        dot(way, Vec3d(corners[2]))});
        return static_cast<float>(height + std::abs(height) * double(kBoxRounding));
    }
    static constexpr float kLowest = -1e30f;
    /// More than a height in the box may be off when reckoned in single precision.
    float slack() const { return slack_; }

  private:
    Vec3 along_;
    std::array<Four, 3> up_, down_; // the way's parts that are positive, and negative
    std::array<Four, 3> low_, high_;
    float slack_;
};

/// The part of a line from `origin` to `end` times `direction` (not zero) beyond it.
class BoxCrossings {
  public:
    BoxCrossings(const Vec3d& origin, const Vec3d& direction, double end);
    /// Over 0 where the line stays clear of the box.
    Four apart(const TriangleTree::Node& node) const;

  private:
    std::array<std::size_t, 3> axis_; // the last is the largest of the direction
    std::array<float, 3> origin_;     // along these axes
    std::array<float, 2> shear_;
    float first_, last_; // along the last axis
    float slack_;
};

} // namespace mane
