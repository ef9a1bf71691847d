#pragma once

#include "interactions/box_tree.h"
#include "model/state.h"

#include <cstdint>
#include <span>
#include <string>

namespace mane {

inline constexpr float kSmallestRadius = 1e-6f; ///< [m] a section squeezed flat still has a depth

/// One end of a segment's volume.
struct VolumeEnd {
    Vec3 x, normal, u, v;
    float radius[kMaxEnvelopePoints] = {};
    float area = 0, rest_area = 0;
};
/// The volume between two cross-sections, inside its box (M21).
struct SegmentVolume {
    VolumeEnd end[2];
    Box box;
};

/// The points of sections: of each its skeleton point, then its K envelope points, `per_section` in
/// all. Each array has sixteen numbers to spare at its end.
struct SectionPoints {
    const float *x = nullptr, *y = nullptr, *z = nullptr;
    std::uint32_t per_section = 0;
};

/// A point inside a segment's volume.
struct PointInside {
    std::uint32_t point = 0; ///< section · per_section + code
    float s = 0;             ///< along the segment, 0 to 1
    float depth = 0;         ///< 0 on the skeleton, 1 on the envelope's surface
    float density = 1;       ///< of strands there, relative to rest, at most 10
};

/// The search for points inside a segment's volume, compiled once per instruction set. All give the
/// same bits.
struct PointTest {
    /// Writes the items whose boxes overlap `box`, as far as they fit into `capacity`, and returns
    /// how many they are.
    std::size_t (*overlapping)(const BoxTree& tree, const Box& box, std::uint32_t* items,
                               std::size_t capacity);
    /// Finds the points of `sections` that are inside; `found` has room for all of them. Returns
    /// how many are, in the order of sections.
    std::size_t (*find)(const SegmentVolume& volume, std::span<const HalfLine> half_lines,
                        const SectionPoints& points, std::span<const std::uint32_t> sections,
                        PointInside* found);
};
/// For an instruction set by name, or the machine's best for "".
PointTest point_test_for(const std::string& instruction_set);

} // namespace mane
