#include "character/ease.h"
#include "step/world_data.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace mane {
namespace {

bool is_finite(const Vec3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// 0 at both ends, with the slope 1 at s = 0 and none at s = 1, C².
Slope runs_out(double s) {
    if (s >= 1)
        return {0, 0};
    return {s + s * s * s * (s * (8 - 3 * s) - 6), 1 + s * s * (s * (32 - 15 * s) - 18)};
}

} // namespace

/// The pin with its place, if it can be.
Pin World::Data::checked(const Pin& pin) const {
    const std::string where = "pin of section " + std::to_string(pin.section) + ": ";
    const Groom& groom = simulation.groom;
    if (pin.section >= groom.section_count())
        throw InputError(where + "expected one of " + std::to_string(groom.section_count()));
    if (!simulation.layout.simulated(pin.section))
        throw InputError(where +
                         "it is on the head; expected the third of its wisp or a later one");
    if (!(pin.ease > 0) || !std::isfinite(pin.ease))
        throw InputError(where + "ease is " + std::to_string(pin.ease) + "; expected over 0 s");
    if (pin.body && *pin.body >= cast.count())
        throw InputError(where + "found body " + std::to_string(*pin.body) + ", expected one of " +
                         std::to_string(cast.count()));
    if (pin.body && pin.bone >= cast.bones(*pin.body))
        throw InputError(where + "found bone " + std::to_string(pin.bone) + ", expected one of " +
                         std::to_string(cast.bones(*pin.body)));
    if (pin.place && !is_finite(*pin.place))
        throw InputError(where + "its place is not finite");
    Pin placed = pin;
    if (!placed.place) {
        const Vec3d here = frame.origin + Vec3d(frame.position[pin.section]);
        placed.place = here;
        if (pin.body) {
            const BonePose bone = cast.bone(*pin.body, pin.bone, frame.time);
            placed.place = bone.rotation.conjugate().rotate(here - bone.position);
        }
    }
    return placed;
}

void World::Data::pin(const Pin& pin) {
    Pinned pinned;
    pinned.pin = checked(pin);
    begin_pin(pinned);
    const auto known = std::find_if(pins_.begin(), pins_.end(),
                                    [&](const Pinned& p) { return p.pin.section == pin.section; });
    if (known != pins_.end()) {
        *known = pinned;
        return;
    }
    const Slot slot = simulation.layout.slot(pin.section);
    simulation.held.points.reserve(pins_.size() + 1);
    pins_.push_back(pinned);
    simulation.held.points.emplace_back().slot = slot;
    simulation.rest.hold(slot);
    simulation.wisp_response.forget_masses();
}

void World::Data::release(std::uint32_t section) {
    const auto known = std::find_if(pins_.begin(), pins_.end(),
                                    [&](const Pinned& p) { return p.pin.section == section; });
    if (known == pins_.end())
        throw InputError("release of section " + std::to_string(section) + ": it is not pinned");
    simulation.held.points.erase(simulation.held.points.begin() + (known - pins_.begin()));
    pins_.erase(known);
    simulation.rest.release(simulation.layout.slot(section), simulation.groom, section);
    simulation.wisp_response.forget_masses();
}

std::vector<Pin> World::Data::pins() const {
    std::vector<Pin> list;
    for (const Pinned& pinned : pins_)
        list.push_back(pinned.pin);
    return list;
}

World::Data::Moving World::Data::target(const Pin& pin, double time) const {
    if (!pin.body)
        return {*pin.place, {}};
    const BonePose bone = cast.bone(*pin.body, pin.bone, time);
    const Vec3d arm = bone.rotation.rotate(*pin.place);
    return {bone.position + arm, bone.velocity + cross(bone.angular_velocity, arm)};
}

/// From where the section is now, as it moves now.
void World::Data::begin_pin(Pinned& pinned) const {
    const Slot slot = simulation.layout.slot(pinned.pin.section);
    const Moving there = target(pinned.pin, frame.time);
    pinned.begun = frame.time;
    pinned.offset = simulation.origin + Vec3d(simulation.state.position.vec(slot)) - there.position;
    pinned.offset_rate = Vec3d(simulation.state.velocity.vec(slot)) - there.velocity;
}

World::Data::Moving World::Data::on_the_way(const Pinned& pinned, double time) const {
    const Moving there = target(pinned.pin, time);
    const double ease_time = pinned.pin.ease, s = (time - pinned.begun) / ease_time;
    const Slope gone = ease(s), run = runs_out(s);
    return {there.position + pinned.offset * (1 - gone.value) +
                pinned.offset_rate * (ease_time * run.value),
            there.velocity - pinned.offset * (gone.rate / ease_time) +
                pinned.offset_rate * run.rate};
}

/// Leads what is held over a block that begins at `time`; `begin` and `end`: of the frame, 0 to 1.
void World::Data::lead_held(double time, double seconds, double begin, double end) {
    for (std::size_t p = 0; p < pins_.size(); ++p)
        for (const int e : {0, 1}) {
            const Moving now = on_the_way(pins_[p], e == 0 ? time : time + seconds);
            Held::Point& point = simulation.held.points[p];
            point.value[e] = Vec3(now.position - simulation.origin);
            point.slope[e] = Vec3(now.velocity * seconds);
        }
    simulation.held.lead_radii(begin, end);
}

} // namespace mane
