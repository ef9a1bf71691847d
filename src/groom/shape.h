#pragma once

#include "mane/vec.h"

#include <span>
#include <vector>

namespace mane {

/// One wisp's curve in double precision with its sections' frames (M7, M8). Sections 0 … n,
/// segments 0 … n−1.
struct Shape {
    std::vector<Vec3d> position; ///< [m] per section
    std::vector<double> length;  ///< [m] per segment
    std::vector<Vec3d> tangent;  ///< per segment
    std::vector<Vec3d> normal;   ///< per section
    std::vector<Vec3d> u, v;     ///< per section: axes of the cross-section

    std::size_t sections() const { return position.size(); }
    std::size_t segments() const { return length.size(); }
};

/// The frames that the curve through `position` carries when section 0 starts with `first_axis`,
/// made normal to the curve.
Shape make_shape(std::span<const Vec3d> position, const Vec3d& first_axis);

} // namespace mane
