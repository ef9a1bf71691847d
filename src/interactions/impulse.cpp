#include "interactions/impulse.h"

namespace mane {

SectionMass SectionMass::of(const HairView& hair, std::uint32_t section) {
    const Slot slot = hair.layout.slot(section);
    return {hair.rest.at(slot, Rest::inverse_mass_across),
            hair.rest.at(slot, Rest::inverse_mass_extra),
            hair.rest.at(slot, Rest::inverse_envelope_mass), hair.frames.normal.vec(slot)};
}

Vec3 half_line_direction(const HairView& hair, Slot slot, std::uint32_t k) {
    const HalfLine& d = hair.half_lines[k];
    return hair.frames.u.vec(slot) * d.cosine + hair.frames.v.vec(slot) * d.sine;
}

} // namespace mane
