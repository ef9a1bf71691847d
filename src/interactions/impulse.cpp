#include "interactions/impulse.h"

#include <cmath>

namespace mane {

// By Cholesky: the inverse masses of an envelope point differ by a factor of twenty between
// directions, and the determinant of such a matrix would lose digits that its factors keep.
Vec3 Symmetric3::solve(const Vec3& b) const {
    const float l11 = std::sqrt(xx), l21 = xy / l11, l31 = xz / l11;
    const float l22 = std::sqrt(yy - l21 * l21), l32 = (yz - l31 * l21) / l22;
    const float l33 = std::sqrt(zz - l31 * l31 - l32 * l32);
    const float y1 = b.x / l11, y2 = (b.y - l21 * y1) / l22, y3 = (b.z - l31 * y1 - l32 * y2) / l33;
    const float z = y3 / l33, y = (y2 - l32 * z) / l22;
    return {(y1 - l21 * y - l31 * z) / l11, y, z};
}

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

Vec3 skeleton_velocity(const HairView& hair, Slot slot) {
    return hair.state.velocity.vec(slot);
}

Vec3 envelope_velocity(const HairView& hair, Slot slot, std::uint32_t k) {
    return hair.state.velocity.vec(slot) +
           half_line_direction(hair, slot, k) * hair.state.radius_rate.at(slot, k);
}

} // namespace mane
