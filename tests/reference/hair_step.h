#pragma once

/// §5.1 for a whole head of hair, with its contacts given: what was detected, by the twin, by the
/// core, or by hand.

#include "mane/desc.h"
#include "reference/character.h"
#include "reference/interactions.h"
#include "reference/twin.h"

#include <vector>

namespace mane::reference {

/// What one step needs from outside. Empty lists: no contacts.
struct HairStep {
    std::vector<Root> start, end; ///< per wisp: where the head holds it before and after
    Surroundings surroundings;
    double h = 1e-3; ///< [s]

    std::vector<Contact> contacts;
    double friction_time =
        0; ///< [s] how long quasi-parallel contacts act in this step; 0: not in this one (M36)
    WispContactDesc wisps;

    std::vector<std::vector<SlidingPlane>> planes; ///< per wisp
    std::vector<std::vector<Shift>> shifts;        ///< per wisp
    CharacterContactDesc character;
};

void step(Hair& hair, const HairStep& input);

} // namespace mane::reference
