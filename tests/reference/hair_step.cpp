#include "reference/hair_step.h"

namespace mane::reference {
namespace {

void process_velocities(Hair& hair, const HairStep& input) {
    for (std::size_t w = 0; w < hair.wisps.size(); ++w) {
        Wisp& wisp = hair.wisps[w];
        set_root_position(wisp, input.start[w]);
        set_root_velocity(wisp, input.start[w]);
        integrate_velocities(wisp, accelerations(wisp, input.surroundings), input.h);
        set_root_velocity(wisp, input.end[w]);
    }
}

/// The character comes last: what the other wisps push may not end inside it.
void modify_velocities(Hair& hair, const HairStep& input) {
    respond(hair, input.contacts, input.wisps, input.friction_time);
    for (std::size_t w = 0; w < input.planes.size(); ++w)
        slide(hair.wisps[w], input.planes[w], input.character, input.h);
}

void process_positions(Hair& hair, const HairStep& input) {
    for (std::size_t w = 0; w < hair.wisps.size(); ++w) {
        integrate_positions(hair.wisps[w], input.h);
        set_root_position(hair.wisps[w], input.end[w]);
    }
}

void modify_positions(Hair& hair, const HairStep& input) {
    for (std::size_t w = 0; w < input.shifts.size(); ++w)
        shift(hair.wisps[w], input.shifts[w]);
}

} // namespace

/// "At each step, all point-masses are processed before going to the next step."
void step(Hair& hair, const HairStep& input) {
    process_velocities(hair, input); // 1. forces, and 3. velocities from them
    modify_velocities(hair, input);  // 3. the interactions that 2. detected
    process_positions(hair, input);  // 4. positions
    modify_positions(hair, input);   // 4. and their modifications
}

} // namespace mane::reference
