#pragma once

#include "interactions/box_tree.h"
#include "interactions/contact_points.h"
#include "interactions/point_test.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mane {

/// The segments that begin at the ranks of a bunch, side by side.
struct AxisBunch {
    BoxTree::Node boxes;   ///< of their volumes; nowhere where none begins
    float x[3][kLanes];    ///< [m] where they begin
    float way[3][kLanes];  ///< [m] from there to where they end
    float widest[kLanes];  ///< [m] no surface is farther from its axis
    std::uint32_t slender; ///< one bit per lane: whether it looks for others itself

    void clear();
    /// Takes the segment that begins at `rank`.
    void set(const ContactPoints& points, std::uint32_t rank, bool is_slender);
};

/// The search for axes that come near to that of a segment, compiled once per instruction set. All
/// give the same answers.
struct AxisSearch {
    /// For up to sixteen slender segments, by the ranks at which they begin: the ranks of the
    /// segments of the near bunches whose boxes overlap theirs, whose directions differ from theirs
    /// by an angle of at least `least_sine`, and whose axes are nearest to theirs between their
    /// ends. All that axis_contact() gives a contact for, and few others, in the order of the
    /// bunches. Of two slender segments, the one of the lower rank finds the other.
    void (*find)(const ContactPoints& points, const AxisBunch* axes,
                 std::span<const std::uint32_t> ranks, float least_sine, const NearBoxes& near,
                 std::vector<std::uint32_t>* found);
};
/// For an instruction set by name, or the machine's best for "".
AxisSearch axis_search_for(const std::string& instruction_set);

} // namespace mane
