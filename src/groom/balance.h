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

/// The smallest bending length [m] above the wisp's own with which the design is stable, to 0.1 %;
/// 0 if even 32 times is not enough.
double stable_bending_length(const WispDesign& wisp, const Shape& shape, const Vec3d& gravity);

} // namespace mane
