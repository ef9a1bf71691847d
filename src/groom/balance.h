#pragma once

#include "groom/material.h"
#include "groom/rest.h"
#include "groom/shape.h"

#include <vector>

namespace mane {

/// The skeleton's spring forces [N] on every section of a wisp at rest that goes through `shape`.
std::vector<Vec3d> skeleton_forces(const Shape& shape, const Material& material, const Rest& rest);

/// Whether a small push away from the design meets resistance whatever its direction: the symmetric
/// part of the tangent stiffness of the skeleton's springs is positive definite (gravity is
/// constant and adds nothing).
bool is_stable(const Shape& shape, const Material& material, const Rest& rest);

/// The bending length [m] with which the design stands: the wisp's own if it does; else the
/// smallest over it that does, to 0.1 %; 0 if 32 times the wisp's own is not enough.
double standing_bending_length(const WispDesign& wisp, const Vec3d& gravity);

/// The largest angle [rad] between a joint's bend at rest and as designed: what its weight unbends.
double largest_droop(const WispDesign& wisp, const Vec3d& gravity);

} // namespace mane
