#pragma once

#include "character/triangle_tree.h"

#include <array>
#include <span>

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
    std::array<float, 3> above_, below_; // the point, widened by the slack
};

/// A convex region that holds some points: their box, cut by a plane across `way` with all of them
/// before it.
class CutBox {
  public:
    /// `way`: best a unit way out of the surface that the points are thought to be clear of. Zero
    /// leaves the box uncut.
    CutBox(const Vec3& way, std::span<const Vec3> points);

    /// Over 0 where nothing in the box is in the region.
    Four apart(const TriangleTree::Node& node) const;
    /// Whether a triangle is wholly behind the plane.
    bool behind(const std::array<Vec3, 3>& corners) const;

  private:
    std::array<float, 3> way_;
    std::array<float, 3> low_, high_;
    float least_; // along the way, of the points, less what rounds
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
