#pragma once

namespace mane {

/// Mechanisms that tests switch off, to see that what is claimed of them fails without them
/// (docs/proofs.md). Neither a scene nor a public header reaches this: a model without them is
/// wrong.
struct Ablation {
    bool reaction = true;       ///< M13: the envelope's springs push back on the skeleton
    bool self_collision = true; ///< M22: a wisp collides with itself
    bool polygon_velocity =
        true;                  ///< M30: contact with a body is relative to its polygon's velocity
    bool clear_regions = true; ///< what cannot touch a body is passed over
    float clear_reach = 1; ///< times what may be met within a block; under 1 contacts are missed
};

} // namespace mane
