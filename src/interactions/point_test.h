#pragma once

#include "interactions/box_tree.h"
#include "interactions/contact_points.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mane {

inline constexpr float kSmallestRadius = 1e-6f; ///< [m] a section squeezed flat still has a depth

/// Points inside a segment's volume, side by side, with room for sixteen more.
struct PointsInside {
    std::size_t count = 0;
    AlignedVector<std::uint32_t> point; ///< rank · 16 + code
    AlignedVector<float> s;             ///< along the segment, 0 to 1
    AlignedVector<float> depth;         ///< 0 on the skeleton, 1 on the envelope's surface
    AlignedVector<float> density;       ///< of strands there, relative to rest, at most 10
    /// Whether they are quasi-parallel by the limits of entering (1) and of leaving (2).
    AlignedVector<std::uint32_t> parallel;

    /// Makes room for so many more.
    void reserve(std::size_t more) {
        const std::size_t room = count + more + kLanes;
        if (point.size() >= room)
            return;
        point.resize(2 * room);
        parallel.resize(2 * room);
        for (AlignedVector<float>* numbers : {&s, &depth, &density})
            numbers->resize(2 * room);
    }
};

/// The limits within which two wisps are quasi-parallel (M23); [0] of entering, [1] of leaving.
struct ParallelLimits {
    float sine[2] = {}, tangent[2] = {}, speed[2] = {};
    float sine_fade = 0; ///< under it their plane is undefined, and only the first counts
};

/// Some boxes by sixteen, and what they are the boxes of: what is near a group of segments.
struct NearBoxes {
    AlignedVector<BoxTree::Node> nodes;
    std::vector<std::uint32_t> items;
};

/// The search for points inside a segment's volume, compiled once per instruction set. All give the
/// same bits.
struct PointTest {
    /// The boxes of all points of bunches [first, last).
    void (*hulls)(const ContactPoints& points, Box* hulls, std::size_t first, std::size_t last);
    /// Gathers the boxes that overlap `box`.
    void (*gather)(const BoxTree& tree, const Box& box, NearBoxes& near);
    /// Finds the points of the near bunches that are inside the volumes of up to sixteen segments,
    /// by the ranks at which they begin, but for a segment's own two sections': for each, in the
    /// order of bunches, codes and ranks.
    void (*find)(const ContactPoints& points, std::span<const std::uint32_t> ranks,
                 const NearBoxes& near, PointsInside* found);
    /// Tells which points in a segment are quasi-parallel to it.
    void (*classify)(const ContactPoints& points, std::uint32_t rank, const ParallelLimits& limits,
                     PointsInside& found);
};
/// For an instruction set by name, or the machine's best for "".
PointTest point_test_for(const std::string& instruction_set);

/// The box of the segment that begins at `rank`: that of its two sections' largest discs.
inline Box segment_box(const ContactPoints& points, std::uint32_t rank) {
    const std::uint32_t next = points.order.next(rank);
    return {first_three(smaller(points.low[rank], points.low[next])),
            first_three(larger(points.high[rank], points.high[next]))};
}

} // namespace mane
