#pragma once

#include "check/hair_geometry.h"

#include <vector>

namespace mane::judge {

/// The drawn envelope across a wisp at one place (M14a): the centre and the ends of the half lines,
/// each on its Catmull-Rom curve.
class DrawnSection {
  public:
    /// At `parameter` = i + t: share t of the way from section i to i + 1 of the wisp.
    void place(const Groom& groom, const HairGeometry& hair, std::size_t wisp, double parameter);

    /// How far `p` is outside, relative to the mean radius here: 0 inside and on the surface.
    double outside(const Vec3d& p) const;

  private:
    Vec3d centre_;
    std::vector<Vec3d> ends_; // relative to the centre
    double mean_radius_ = 0;
};

} // namespace mane::judge
