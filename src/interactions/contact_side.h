#pragma once

#include "interactions/wisp_contact.h"
#include "model/state.h"

namespace mane {

/// The direction of a wisp at a contact's point, and the velocity of that point.
struct ContactSide {
    Vec3 direction;
    Vec3 velocity;
};
ContactSide point_side(const HairView& hair, const WispContact& contact);
ContactSide segment_side(const HairView& hair, const WispContact& contact);

} // namespace mane
