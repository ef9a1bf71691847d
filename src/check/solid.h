#pragma once

#include "check/closed_topology.h"

#include <limits>

namespace mane::judge {

/// What a body fills in one frame. Inside is where the winding number of its closed surface is at
/// least ½ (M33), so parts may overlap.
///
/// The winding number of a closed surface is the number of times a ray from the point leaves it
/// less the times it enters, which needs a column of triangles where solid angles need all. Each
/// edge decides alone, and alike for both its triangles, on which side of it a ray passes: no ray
/// slips between two triangles or meets both.
class Solid {
  public:
    /// `vertices` [m]: the body's, as posed.
    Solid(const ClosedTopology& topology, std::span<const Vec3> vertices);

    int winding(const Vec3d& p) const;
    bool contains(const Vec3d& p) const { return winding(p) > 0; }
    /// [m] How far it is from a point inside to the nearest point outside; infinite if over
    /// `limit`. Surfaces of one part inside another do not count.
    double depth(const Vec3d& p, double limit = std::numeric_limits<double>::infinity()) const;
    /// Whether any of the straight line from `a` to `b` is inside.
    bool meets(const Vec3d& a, const Vec3d& b) const;

  private:
    struct Triangle {
        Vec3d a, b, c;
        double low, high; // of y
    };
    struct Cells {
        int x0, x1, z0, z1;
    };

    Cells cells(const Vec3d& low, const Vec3d& high) const;
    template <typename Visit>
    void visit_near(const Vec3d& low, const Vec3d& high, const Visit& visit) const;
    double depth_within(const Vec3d& p, double limit) const;

    std::vector<Triangle> triangles_;
    Vec3d low_, high_;
    double cell_ = 1;
    int nx_ = 0, nz_ = 0;
    std::vector<std::uint32_t> first_, listed_; // triangles over each cell of the ground plan
};

} // namespace mane::judge
