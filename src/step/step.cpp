#include "step/step.h"

namespace mane {
namespace {

void feel_wind(Simulation& s, double time) {
    if (s.air.is_uniform())
        return;
    for (std::uint32_t section = 0; section < s.groom.section_count(); ++section) {
        const Slot slot = s.layout.slot(section);
        s.wind.set(slot, s.air.velocity(s.origin + Vec3d(s.state.position.vec(slot)), time));
    }
}

void detect_wisp_contacts(Simulation& s) {
    if (s.desc.wisps.mode == WispContactMode::off)
        return;
    const StageTimer timer(s.statistics, Stage::wisp_detection);
    s.wisp_detection.detect(s.hair(), s.threads);
    s.wisp_response.engage(s.hair(), s.wisp_detection.contacts());
    ++s.statistics.wisp_detections;
    s.statistics.intersections += s.wisp_detection.intersecting_pairs();
    for (const WispContact& c : s.wisp_detection.contacts())
        ++(c.kind == WispContactKind::friction ? s.statistics.friction_contacts
                                               : s.statistics.collision_contacts);
}

/// 2. Interactions between pairs of wisps, and between wisps and the character. Forces and
/// detection read the same state and write apart, so detection may come first; then forces flow
/// straight into the velocities.
void detect_interactions(Simulation& s, const StepPlace& place) {
    if (!place.first())
        return;
    const KernelData data = s.kernel_data();
    s.for_packets(
        [&](std::size_t first, std::size_t last) { s.kernels.section_frames(data, first, last); });
    if (place.detects_wisps)
        detect_wisp_contacts(s);
}

/// 1. Gravity, air resistance, springs; and the first half of 3., velocities from them.
void process_forces(Simulation& s) {
    const StageTimer timer(s.statistics, Stage::forces);
    const KernelData data = s.kernel_data();
    s.for_packets(
        [&](std::size_t first, std::size_t last) { s.kernels.process_forces(data, first, last); });
}

/// 3. The velocity modifications. Quasi-parallel contacts are answered once per block for its whole
/// length, collisions at every step (M36); nothing is held for `paper-literal`.
void modify_velocities(Simulation& s, const StepPlace& place) {
    const StageTimer timer(s.statistics, Stage::velocities);
    const KernelData data = s.kernel_data();
    s.for_packets([&](std::size_t first, std::size_t last) {
        s.kernels.move_root_velocities(data, place.end(), first, last);
    });
    if (s.desc.wisps.mode == WispContactMode::off)
        return;
    if (!s.desc.schedule.hold_contacts && !(place.first() && place.detects_wisps))
        return;
    const float friction_time = place.first() ? s.roots.seconds : 0.f;
    s.wisp_response.apply(s.hair(), s.state, friction_time, s.threads);
}

/// 4. Positions from the new velocities.
void process_positions(Simulation& s, const StepPlace& place) {
    const StageTimer timer(s.statistics, Stage::positions);
    const KernelData data = s.kernel_data();
    s.for_packets([&](std::size_t first, std::size_t last) {
        s.kernels.process_positions(data, place.end(), first, last);
    });
}

} // namespace

void step(Simulation& s, const StepPlace& place, double time) {
    if (place.first())
        feel_wind(s, time);
    detect_interactions(s, place);
    process_forces(s);
    modify_velocities(s, place);
    process_positions(s, place);
    ++s.statistics.steps;
}

} // namespace mane
