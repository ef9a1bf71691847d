#pragma once

#include "mane/frame.h"
#include "mane/groom.h"

#include <cstdint>

namespace mane::reference {

/// What random hair to make. Everything else is drawn within sane ranges, keyed by the seed.
struct RandomHair {
    std::uint64_t seed = 1;
    std::uint32_t wisps = 1;
    std::uint32_t points = 4;         ///< K
    std::uint32_t least_sections = 2; ///< per wisp, x₀ included; 2: a wisp that is all root
    std::uint32_t most_sections = 33;
    double spread = 0.3;   ///< [m] roots lie in a box of this size
    double sharpest = 170; ///< [deg] largest bend of a joint
    bool vanishing = true; ///< in states: some segments have no length, some radii are 0
};

/// Random masses, springs and rest shapes: bent wisps with rest curvatures that do not fit their
/// shape, so that every spring pulls.
Groom random_groom(const RandomHair& hair);

/// A random state of it: shapes around the design, velocities of a few m/s, radii from 0 to twice
/// their rest. In floats, so that core and twin start from the same numbers. Roots move too.
Frame random_state(const RandomHair& hair, const Groom& groom, std::uint64_t state_seed);

} // namespace mane::reference
