#pragma once

#include "base/four.h"
#include "model/state.h"

namespace mane {

/// How a section answers impulses (docs/model.md, "Response of a point to an impulse"): T⁻¹ =
/// across·I + extra·n nᵀ for the skeleton point, 1/m for the motion of an envelope point along its
/// half line. All zero for a kinematic section.
struct SectionMass {
    float across = 0, extra = 0, envelope = 0;
    Four normal{};

    static SectionMass of(const HairView& hair, Slot slot) {
        return {hair.rest.at(slot, Rest::inverse_mass_across),
                hair.rest.at(slot, Rest::inverse_mass_extra),
                hair.rest.at(slot, Rest::inverse_envelope_mass),
                four(hair.frames.normal.vec(slot))};
    }
    Four skeleton_response(const Four& impulse) const {
        return impulse * four(across) + normal * four(dot(normal, impulse) * extra);
    }
};

/// Direction of half line k of a section, in the world.
inline Vec3 half_line_direction(const HairView& hair, Slot slot, std::uint32_t k) {
    const HalfLine& d = hair.half_lines[k];
    return hair.frames.u.vec(slot) * d.cosine + hair.frames.v.vec(slot) * d.sine;
}

} // namespace mane
