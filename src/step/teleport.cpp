#include "step/world_data.h"

#include <cmath>

namespace mane {
namespace {

bool is_finite(const BonePose& pose) {
    const auto& [p, q, v, w] = pose;
    return std::isfinite(dot(p, p) + dot(q, q) + dot(v, v) + dot(w, w));
}

/// Carries a point that is fixed to a bone, or moves relative to it, from one motion of the bone to
/// another.
struct Carrier {
    const BonePose& from;
    const BonePose& to;

    Vec3d position(const Vec3d& p) const {
        return to.rotation.rotate(in_bone(p - from.position)) + to.position;
    }
    Vec3d velocity(const Vec3d& v, const Vec3d& p) const {
        const Vec3d relative =
            v - (from.velocity + cross(from.angular_velocity, p - from.position));
        return to.rotation.rotate(in_bone(relative)) + to.velocity +
               cross(to.angular_velocity, position(p) - to.position);
    }

  private:
    Vec3d in_bone(const Vec3d& v) const { return from.rotation.conjugate().rotate(v); }
};

} // namespace

void World::Data::carry_hair(const BonePose& from, const BonePose& to) {
    const Carrier carrier{from, to};
    const Vec3d origin = simulation.origin, next = nearby_origin(frame.time);
    State& state = simulation.state;
    for (std::uint32_t section = 0; section < simulation.groom.section_count(); ++section) {
        const Slot slot = simulation.layout.slot(section);
        const Vec3d p = origin + Vec3d(state.position.vec(slot)), v(state.velocity.vec(slot));
        state.position.set(slot, Vec3(carrier.position(p) - next));
        state.velocity.set(slot, Vec3(carrier.velocity(v, p)));
    }
    simulation.origin = next;
}

/// Places in the world go along; those on bones are where the bones are now.
void World::Data::carry_pins(const BonePose& from, const BonePose& to) {
    for (Pinned& pinned : pins_) {
        if (!pinned.pin.body)
            pinned.pin.place = Carrier{from, to}.position(*pinned.pin.place);
        begin_pin(pinned);
    }
}

void World::Data::teleport() {
    const BonePose head = cast.head(frame.time);
    if (!is_finite(head))
        throw InputError("teleport: the head's motion is not finite at time " +
                         std::to_string(frame.time) + " s");
    if (head == head_)
        return;
    carry_hair(head_, head);
    carry_pins(head_, head);
    place_roots(frame.time);
    // What wisps do to each other goes along with them; how they lie on bodies is looked for anew.
    simulation.character_contacts.forget();
    publish();
}

} // namespace mane
