#pragma once

#include "model/state.h"

#include <cstdint>
#include <span>
#include <string>

namespace mane {

/// What is known of a section's surroundings: a part of space that moves with a rigid frame of a
/// body, outside the body and with nothing of its surface. It has two pieces that share a centre: a
/// ball, and what a larger ball has over a plane. In the frame's own coordinates, one number each,
/// in this order.
struct ClearRegion {
    enum Column : std::uint32_t {
        frame,      ///< negative where nothing is known
        centre,     ///< [m] three numbers
        normal = 4, ///< of the plane, unit
        height = 7, ///< [m] of the plane along it
        radius,     ///< [m] of the larger ball
        ball,       ///< [m] the smaller one's radius
        far,        ///< [m] from the centre; no other group is nearer
        stray,      ///< [m] how far the others stray from the frame over the present block
        age,        ///< [m] how far they have since the region was found
        wait,       ///< blocks for which it is not looked for again
        pause,      ///< how many those will be the next time
        count
    };
};

/// A frame of a body over a block.
struct FrameMotion {
    Vec3 x[2], y[2], z[2], origin[2];   ///< at the start and at the end
    Vec3 turn_x, turn_y, turn_z, shift; ///< p goes by turn_x p.x + turn_y p.y + … + shift
    float turn = 0; ///< [1] two places part by at most so much of their distance
    float any = 0;  ///< [m] the farthest that any group strays
};

/// What the regions of all sections are asked, for one body.
struct RegionQuestion {
    const Layout& layout;
    const State& state;
    const SectionFrames& frames;
    std::span<const HalfLine> half_lines;
    Rows& region;
    std::span<const FrameMotion> motion;
    float duration = 0; ///< [s] of the block
    float share = 1;    ///< [1] of the bound on what may be met: Ablation::clear_reach
    float reach = 0; ///< [m] what is no farther than this may be met, beside what velocities bring
};

/// Sixteen wisps at a time, compiled once per instruction set. All give the same bits. Answers come
/// per row of the packet, a bit per lane.
struct RegionTest {
    /// At a block's start. Counts for row i: whether its section could touch the surface within the
    /// block; whether the middle of the segment that ends there could; whether the region is used
    /// up. A region that does not hold its section is forgotten.
    struct Approach {
        std::uint16_t section = 0, segment = 0, spent = 0;
    };
    void (*approach)(const RegionQuestion& question, std::size_t packet, Approach* rows);
    /// At a block's end: takes the regions there, and tells in which rows all that hangs on the
    /// section and on the halves of its segments is inside the region.
    void (*stay)(const RegionQuestion& question, std::size_t packet, std::uint16_t* rows);
};
RegionTest region_test_for(const std::string& instruction_set);

} // namespace mane
