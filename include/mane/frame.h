#pragma once

#include "mane/vec.h"

#include <cstdint>
#include <vector>

namespace mane {

/// The hair at one time: what is stored, drawn and judged. Sections in the groom's order.
struct Frame {
    std::uint32_t index = 0;
    double time = 0; ///< [s]
    Vec3d origin;    ///< [m] world position that `position` is relative to; it follows the head
    std::vector<Vec3> first_axis;   ///< per wisp: unit first axis of section 0; with the curve it
                                    ///< gives every section's frame (M8)
    std::vector<Vec3> position;     ///< [m] per section
    std::vector<Vec3> velocity;     ///< [m/s] per section, in world axes
    std::vector<float> radius;      ///< [m] sections × K
    std::vector<float> radius_rate; ///< [m/s] sections × K
};

} // namespace mane
