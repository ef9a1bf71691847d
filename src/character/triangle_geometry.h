#pragma once

#include "mane/vec.h"

namespace mane {

/// A triangle's corners, in double so that differences of floats are exact.
struct Triangle {
    Vec3d a, b, c;
};

/// The point of a triangle that is nearest to another point.
struct ClosestPoint {
    Vec3d point;
    Vec3d barycentric;  ///< sum 1; exactly 0 for the corners that the point's edge or corner leaves
                        ///< out
    double squared = 0; ///< squared distance [m²]
};
ClosestPoint closest_on_triangle(const Vec3d& p, const Triangle& t);

/// A directed line, prepared for crossing triangles.
///
/// Watertight by construction. Seen along the line every vertex is a point of the plane, and a
/// triangle is crossed as often as its outline winds round the origin. That number is a sum over
/// its three edges of "crosses the positive x axis, upward +1, downward −1", and an edge gives the
/// same answer to both of its triangles, rounding included: over a closed mesh all edges cancel, so
/// the crossings of a line always sum to zero. None is lost or counted twice at a shared edge or
/// vertex. (Tests by the signs of three edge functions have no such guarantee near a vertex.)
class LineCrossing {
  public:
    /// From `origin` along `direction` (not zero).
    LineCrossing(const Vec3d& origin, const Vec3d& direction);

    struct Hit {
        int sign = 0;  ///< +1 entering through the front face, −1 leaving, 0 none
        double at = 0; ///< position on the line: 0 at the origin, 1 at origin + direction
    };
    Hit cross(const Triangle& t) const;

  private:
    struct Seen {
        double x, y, at;
    };
    Seen see(const Vec3d& p) const;

    int x_ = 0, y_ = 1, z_ = 2; // axes, z the largest of the direction
    double shear_x_ = 0, shear_y_ = 0, per_z_ = 1;
    Vec3d origin_;
};

} // namespace mane
