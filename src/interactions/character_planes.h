#pragma once

#include "character/surface.h"

#include <vector>

namespace mane {

/// A plane that a point could reach: where it touches the surface and which way it faces, at the
/// block's start.
struct NearPlane {
    SurfacePlace place;
    Vec3d normal;         ///< unit
    double distance = 0;  ///< [m]
    double threshold = 0; ///< [m]
};

/// Speed that a point may gain in a block on top of what it has [m/s²]: the hardest head of the
/// captured clips, 57 m/s². In a block of 1/120 s it widens the search by 4 mm. What comes faster
/// still is the penetration reaction's.
inline constexpr double kAcceleration = 57;

/// A point and how it could move within the block.
struct Approach {
    Vec3d position;       ///< [m]
    Vec3d velocity;       ///< [m/s]
    double speed = 0;     ///< [m/s] bound on its speed relative to the polygons around
    double threshold = 0; ///< [m] of sliding contact
    double push_out = 0;  ///< [m]

    /// [m] the farthest that it slides relative to the polygons around in a block of that length
    double slide(double block) const { return (speed + kAcceleration * block) * block; }
    /// [m] nothing farther off can become a plane in such a block
    double reach(double block) const { return threshold + slide(block); }
};

/// Velocity of a place of the surface over the block [m/s].
Vec3d velocity_at(const Surface& surface, const SurfacePlace& place);

/// Finds the planes, at most three, that a point could reach within the block. Scratch is kept
/// between calls.
class PlaneFinder {
  public:
    const std::vector<NearPlane>& find(const Surface& surface, const Approach& approach);

  private:
    bool reachable(const Surface& surface, const Approach& approach, const NearPlane& plane) const;
    bool implied(const NearPlane& plane) const;
    NearPlane blended(const NearPlane& plane) const;
    void halve_pinched_gaps();

    PlaceRows rows_;
    std::vector<SurfacePlace> around_;
    std::vector<NearPlane> found_, planes_;
};

} // namespace mane
