#include "interactions/literal_response.h"

#include "interactions/contact_side.h"
#include "interactions/impulse.h"

#include <vector>

namespace mane {
namespace {

Vec3 change_of(const HairView& hair, const WispContact& contact, const WispContactDesc& desc,
               float friction_time) {
    const ContactSide p = point_side(hair, contact), s = segment_side(hair, contact);
    const Vec3 v = p.velocity - s.velocity;
    if (contact.kind == WispContactKind::collision)
        return v * -0.5f;
    const Vec3 bare = cross(p.direction, s.direction), n = normalized(bare);
    const float drag = desc.friction * contact.density * friction_time;
    return bare * (-0.5f * dot(v, bare)) - (v - n * dot(v, n)) * drag;
}

} // namespace

void respond_literally(const HairView& hair, std::span<const WispContact> contacts,
                       const WispContactDesc& desc, float friction_time, State& state) {
    std::vector<Vec3> changes(contacts.size()); // all from the velocities before
    for (std::size_t i = 0; i < contacts.size(); ++i)
        changes[i] = change_of(hair, contacts[i], desc, friction_time);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const WispContact& c = contacts[i];
        if (c.point.is_axis() || !hair.layout.simulated(c.section))
            continue;
        const Slot slot = hair.layout.slot(c.section);
        if (c.point.is_envelope()) {
            const Vec3 d = half_line_direction(hair, slot, c.point.k());
            state.radius_rate.at(slot, c.point.k()) += dot(changes[i], d);
        } else {
            state.velocity.set(slot, state.velocity.vec(slot) + changes[i]);
        }
    }
}

} // namespace mane
