#pragma once

#include "interactions/box_tree.h"
#include "interactions/contact_points.h"

#include <cstdint>
#include <span>
#include <string>

namespace mane {

/// The segments that begin at the ranks of a bunch, side by side.
struct AxisBunch {
    BoxTree::Node boxes;  ///< of their volumes; nowhere where none begins
    float x[3][kLanes];   ///< [m] where they begin
    float way[3][kLanes]; ///< [m] from there to where they end
    float widest[kLanes]; ///< [m] no surface is farther from its axis

    void clear();
    /// Takes the segment that begins at `rank`.
    void set(const ContactPoints& points, std::uint32_t rank);
};

/// The search for axes that come near to that of a segment, compiled once per instruction set. All
/// give the same answers.
struct AxisSearch {
    /// Writes the ranks of the segments of `bunches` whose boxes overlap that of the segment at
    /// `rank`, whose directions differ from its own by an angle of at least `least_sine`, and whose
    /// axes are nearest to its own between their ends: all that axis_contact() gives a contact for,
    /// and few others. Rising, if the bunches are. Returns how many they are.
    std::size_t (*near)(const ContactPoints& points, const AxisBunch* axes, std::uint32_t rank,
                        float least_sine, std::span<const std::uint32_t> bunches,
                        std::uint32_t* others);
};
/// For an instruction set by name, or the machine's best for "".
AxisSearch axis_search_for(const std::string& instruction_set);

} // namespace mane
