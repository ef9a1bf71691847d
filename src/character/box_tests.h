#pragma once

#include "character/triangle_tree.h"

#include <array>

namespace mane {

// Which of a node's four boxes a query must look into: bounds in single precision, widened by more
// than its rounding, so that no box is left out wrongly. What is found in the boxes is exact.

/// Distances from a point.
class BoxDistances {
  public:
    explicit BoxDistances(const Vec3d& p);
    /// Squared, never more than to any triangle in the box.
    Four squared(const TriangleTree::Node& node) const;

  private:
    std::array<float, 3> p_;
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
