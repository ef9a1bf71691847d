#pragma once

#include "interactions/wisp_contact.h"
#include "mane/desc.h"
#include "model/state.h"

#include <span>

namespace mane {

/// The velocity modifications of §4.1 as printed, for study: half of the relative velocity at the
/// point of each contact, added over all contacts, and the bare product σ_p × σ_s. Many contacts on
/// one point multiply its energy, which is why `WispResponse` exists. `friction_time` [s]: the time
/// that the drag between quasi-parallel wisps stands for.
void respond_literally(const HairView& hair, std::span<const WispContact> contacts,
                       const WispContactDesc& desc, float friction_time, State& state);

} // namespace mane
