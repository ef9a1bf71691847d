#pragma once

#include "groom/material.h"
#include "groom/shape.h"

#include <vector>

namespace mane {

/// One wisp's rest shape (M44): natural lengths, curvatures and radii for which the springs alone
/// balance gravity in the design.
struct Rest {
    std::vector<double> length;         ///< [m] per segment; the kinematic segment 0 keeps its own
    std::vector<double> bend_stiffness; ///< [N·m/rad] per section; 0 where no joint is
    std::vector<double> bend_damping;   ///< [N·m·s/rad] per section
    std::vector<double> curvature_u, curvature_v; ///< [rad] per section
    std::vector<double> radius;                   ///< [m] sections × K
    std::vector<double> ring_length;              ///< [m] sections × K
};

/// Throws InputError where no natural length, bend or radius can carry the weight (too compressed,
/// folded, too soft).
Rest make_rest(const WispDesign& wisp, const Shape& shape, const Material& material,
               const Vec3d& gravity);

} // namespace mane
