#pragma once

#include "step/simulation.h"

namespace mane {

/// Where a step stands in its detection block.
struct StepPlace {
    std::uint32_t index = 0; ///< of the step in the block
    std::uint32_t steps = 1; ///< steps of the block
    bool detects_wisps =
        false; ///< contacts between wisps are looked for at the beginning of this block
    bool counts_intersections = false; ///< then

    bool first() const { return index == 0; }
    bool last() const { return index + 1 == steps; }
    /// Time at the step's beginning and end, 0 to 1 over the block.
    float begin() const { return static_cast<float>(index) / static_cast<float>(steps); }
    float end() const { return static_cast<float>(index + 1) / static_cast<float>(steps); }
};

/// One step of §5.1. The block's root motion must be set.
void step(Simulation& s, const StepPlace& place, double time);

} // namespace mane
