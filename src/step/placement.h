#pragma once

#include "step/cast.h"
#include "step/simulation.h"

namespace mane {

/// Puts the groom as designed into the first body's pose at `time`, at rest relative to the body:
/// each section is carried by the bones that carry the nearest place of the skin, so that hair laid
/// over the shoulders stays there when the head is turned. In the rest pose this is the design
/// itself.
void place_groom(Simulation& s, const Cast& cast, double time);

} // namespace mane
