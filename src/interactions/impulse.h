#pragma once

#include "model/state.h"

namespace mane {

/// How a section answers impulses (docs/model.md, "Response of a point to an impulse"): T⁻¹ =
/// across·I + extra·n nᵀ for the skeleton point, 1/m for the motion of an envelope point along its
/// half line. All zero for a kinematic section.
struct SectionMass {
    float across = 0, extra = 0, envelope = 0;
    Vec3 normal;

    static SectionMass of(const HairView& hair, std::uint32_t section) {
        const Slot slot = hair.layout.slot(section);
        return {hair.rest.at(slot, Rest::inverse_mass_across),
                hair.rest.at(slot, Rest::inverse_mass_extra),
                hair.rest.at(slot, Rest::inverse_envelope_mass), hair.frames.normal.vec(slot)};
    }
    Vec3 skeleton_response(const Vec3& impulse) const {
        return impulse * across + normal * (dot(normal, impulse) * extra);
    }
};

/// Direction of half line k of a section, in the world.
inline Vec3 half_line_direction(const HairView& hair, Slot slot, std::uint32_t k) {
    const HalfLine& d = hair.half_lines[k];
    return hair.frames.u.vec(slot) * d.cosine + hair.frames.v.vec(slot) * d.sine;
}

} // namespace mane
