#pragma once

/// §4.2, collisions with the character, for planes and places that are given: what finds them works
/// on a mesh, and is tested against brute force over its polygons.

#include "mane/desc.h"
#include "reference/twin.h"

#include <cstddef>
#include <vector>

namespace mane::reference {

/// A point of a wisp that can touch a body: in each of two neighbouring sections, x + α r_k d_k + β
/// r_{k+1} d_{k+1}, mixed by `along`. The skeleton point has α = β = 0, envelope point k has α = 1.
struct BodyPoint {
    std::size_t section = 0;
    double along = 0;
    std::size_t k = 0;
    double alpha = 0, beta = 0;
};
Vec3d position_of(const Wisp& wisp, const BodyPoint& point);
Vec3d velocity_of(const Wisp& wisp, const BodyPoint& point);

/// The plane of a polygon, as it is and moves now.
struct SlidingPlane {
    BodyPoint point;       ///< what it holds off
    Vec3d anchor;          ///< [m] a point of the polygon
    Vec3d anchor_velocity; ///< [m/s]
    Vec3d normal;          ///< away from the body; any length
    Vec3d normal_rate;     ///< [1/s] its change
    double threshold = 0;  ///< [m] sliding contact begins under this distance
};

/// Sliding contact (M30): velocity modifications in a step of length `h`, in the order of the
/// planes.
void slide(Wisp& wisp, const std::vector<SlidingPlane>& planes, const CharacterContactDesc& desc,
           double h);

/// Where the penetration reaction puts a section.
struct Shift {
    std::size_t section = 0;
    Vec3d position; ///< [m]
    Ring radii;     ///< [m]
};
/// Penetration reaction (M32): "a shift leaves velocity otherwise unchanged".
void shift(Wisp& wisp, const std::vector<Shift>& shifts);

} // namespace mane::reference
