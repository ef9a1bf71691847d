#include "interactions/contact_side.h"

#include "interactions/impulse.h"

namespace mane {
namespace {

Vec3 segment_direction(const HairView& hair, std::uint32_t segment) {
    return normalized(hair.state.position.vec(hair.layout.slot(segment + 1)) -
                      hair.state.position.vec(hair.layout.slot(segment)));
}

Vec3 segment_velocity(const HairView& hair, std::uint32_t segment, float s) {
    return hair.state.velocity.vec(hair.layout.slot(segment)) * (1 - s) +
           hair.state.velocity.vec(hair.layout.slot(segment + 1)) * s;
}

Vec3 point_velocity(const HairView& hair, const WispContact& contact) {
    if (contact.point.is_axis())
        return segment_velocity(hair, contact.section, contact.along);
    const Slot slot = hair.layout.slot(contact.section);
    const Vec3 velocity = hair.state.velocity.vec(slot);
    if (!contact.point.is_envelope())
        return velocity;
    const std::uint32_t k = contact.point.k();
    return velocity + half_line_direction(hair, slot, k) * hair.state.radius_rate.at(slot, k);
}

} // namespace

ContactSide point_side(const HairView& hair, const WispContact& contact) {
    return {contact.point.is_axis() ? segment_direction(hair, contact.section)
                                    : hair.frames.normal.vec(hair.layout.slot(contact.section)),
            point_velocity(hair, contact)};
}

ContactSide segment_side(const HairView& hair, const WispContact& contact) {
    return {segment_direction(hair, contact.segment),
            segment_velocity(hair, contact.segment, contact.s)};
}

} // namespace mane
