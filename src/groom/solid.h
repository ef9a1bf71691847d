#pragma once

#include "character/closing.h"
#include "character/posed_surface.h"
#include "mane/body.h"

namespace mane {

/// A body in its rest pose, as something that hair lies on.
class Solid {
  public:
    explicit Solid(const Mesh& mesh);
    Solid(const Solid&) = delete; // the surface refers to the triangles
    Solid& operator=(const Solid&) = delete;

    struct Clearance {
        double distance = 0; ///< [m] to the surface, negative inside
        Vec3d outward;       ///< unit: where the distance grows fastest
    };
    /// Distances over 0.25 m count as that, straight up: hair that far away touches nothing.
    Clearance clearance(const Vec3d& p) const;

    /// `p` moved out to a distance of at least `least` [m].
    Vec3d moved_out(Vec3d p, double least) const;

  private:
    ClosedMesh closed_;
    PosedSurface surface_;
};

} // namespace mane
