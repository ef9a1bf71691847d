#include "step/step.h"

#include "interactions/literal_response.h"

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

void find_section_frames(Simulation& s) {
    const KernelData data = s.kernel_data();
    s.for_packets(
        [&](std::size_t first, std::size_t last) { s.kernels.section_frames(data, first, last); });
}

void detect_wisp_contacts(Simulation& s, bool count_intersections) {
    const StageTimer timer(s, Stage::wisp_detection);
    s.wisp_detection.detect(s.hair(), s.contact_geometry.points(), s.threads, count_intersections);
    s.wisp_response.engage(s.hair(), s.contact_geometry, s.wisp_detection.list(), s.threads);
    ++s.statistics.wisp_detections;
    s.statistics.intersection_counts += count_intersections;
    s.statistics.intersections +=
        2 * s.wisp_detection.intersecting_pairs(); // each from both of its segments
    const std::uint64_t friction = s.wisp_detection.friction_contacts();
    s.statistics.friction_contacts += friction;
    s.statistics.collision_contacts += s.wisp_detection.list().size() - friction;
}

void detect_character_contacts(Simulation& s) {
    const StageTimer timer(s, Stage::character_detection);
    s.character_contacts.detect(s.hair(), s.bodies, s.desc.character, s.threads);
    ++s.statistics.character_detections;
    s.statistics.sliding_contacts += s.character_contacts.count();
}

/// Engaged contacts are answered every step (M36); nothing is held for `paper-literal`.
void answer_wisp_contacts(Simulation& s, const StepPlace& place) {
    const bool found_now = place.first() && place.detects_wisps;
    if (!s.desc.schedule.hold_contacts && !found_now)
        return;
    const float step = static_cast<float>(s.schedule.step_seconds());
    if (s.desc.wisps.literal) {
        respond_literally(s.hair(), s.wisp_detection.list().all(s.contact_geometry.points().order),
                          s.desc.wisps, step, s.state);
        return;
    }
    if (place.first())
        s.wisp_response.prepare(s.contact_geometry, step, s.threads);
    s.wisp_response.apply(s.hair(), s.contact_geometry, s.state, s.threads);
}

void answer_character_contacts(Simulation& s, const StepPlace& place) {
    if (!s.desc.schedule.hold_contacts && !place.first())
        return;
    s.character_contacts.respond(s.hair(), s.desc.character, place.begin(),
                                 static_cast<float>(s.schedule.step_seconds()), s.state, s.threads);
}

/// 1. Forces: gravity, air resistance, springs; and the first half of 3., velocities from them.
void process_forces(Simulation& s, const StepPlace& place) {
    const StageTimer timer(s, Stage::forces);
    const KernelData data = s.kernel_data();
    s.held.note_velocities(s.state);
    s.for_packets(
        [&](std::size_t first, std::size_t last) { s.kernels.process_forces(data, first, last); });
    s.held.accelerate_envelopes(data, place.end());
}

/// 2. Interactions between pairs of wisps, and between wisps and the character. Forces and
/// detection read the same state and write apart, so detection may come first; then forces flow
/// straight into the velocities.
void detect_interactions(Simulation& s, const StepPlace& place) {
    if (!place.first())
        return;
    find_section_frames(s);
    if (s.desc.wisps.mode != WispContactMode::off)
        s.contact_geometry.take(s.hair(), s.threads);
    if (place.detects_wisps && s.desc.wisps.mode != WispContactMode::off)
        detect_wisp_contacts(s, place.counts_intersections);
    detect_character_contacts(s);
}

/// 3. The velocity modifications. The character comes last: what wisps do to each other must not
/// push one into it.
void modify_velocities(Simulation& s, const StepPlace& place) {
    const StageTimer timer(s, Stage::velocities);
    const KernelData data = s.kernel_data();
    s.for_packets([&](std::size_t first, std::size_t last) {
        s.kernels.move_root_velocities(data, place.end(), first, last);
    });
    s.held.move(s.state, place.end(), data.roots.seconds);
    if (s.desc.wisps.mode != WispContactMode::off)
        answer_wisp_contacts(s, place);
    answer_character_contacts(s, place);
}

/// 4. Positions from the new velocities.
void process_positions(Simulation& s, const StepPlace& place) {
    const StageTimer timer(s, Stage::positions);
    const KernelData data = s.kernel_data();
    s.for_packets([&](std::size_t first, std::size_t last) {
        s.kernels.process_positions(data, place.end(), first, last);
    });
    s.held.place(s.state, place.end());
}

/// 4. The position modifications: on the new positions, against the character at the step's end.
void modify_positions(Simulation& s, const StepPlace& place) {
    if (!place.last())
        return;
    const StageTimer timer(s, Stage::character_detection);
    find_section_frames(s);
    s.statistics.penetration_reactions +=
        s.character_contacts.react(s.hair(), s.bodies, s.desc.character, s.state, s.threads);
    const std::span<const Reaction> reactions = s.character_contacts.reactions();
    s.reactions.insert(s.reactions.end(), reactions.begin(), reactions.end());
}

} // namespace

void step(Simulation& s, const StepPlace& place, double time) {
    if (place.first())
        feel_wind(s, time);
    detect_interactions(s, place);
    process_forces(s, place);
    modify_velocities(s, place);
    process_positions(s, place);
    modify_positions(s, place);
    ++s.statistics.steps;
}

} // namespace mane
