#pragma once

#include "mane/groom.h"

#include <string>

namespace mane {

/// How long an explicit step may be (M37).
struct StepLimit {
    double step = 0;       ///< [s] largest stable step of the whole groom
    std::size_t wisp = 0;  ///< the wisp that limits it
    std::string parameter; ///< the parameter that alone would limit this wisp the most, by its name
                           ///< in a scene
};

/// Symplectic Euler with damping at the old velocities is stable exactly while 4 M − h² K − 2 h C
/// is positive definite. K and C are taken where they are largest: each wisp straight, its radial
/// springs squeezed to where they stop stiffening, its joints swollen to where their stiffness is
/// capped, and sections turned by 30° from their segments. The limit found so is at most about
/// 10 % under the true one of that state. `drag` [1/s] is the air's.
StepLimit step_limit(const Groom& groom, double drag);

/// Throws InputError if steps of `step` [s] would be unstable; the message names wisp, parameter
/// and the longest that is not.
void require_stable_step(const Groom& groom, double drag, double step);

} // namespace mane
