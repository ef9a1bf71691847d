#pragma once

#include "interactions/contact_points.h"

#include <cstdint>
#include <optional>

namespace mane {

/// Where the axes of two segments are nearest to each other.
struct AxisContact {
    float on_first = 0, on_second = 0; ///< along each, 0 to 1
    float depth = 0;                   ///< their distance over the sum of the two radii there
    float density = 1;                 ///< of strands in the second, relative to rest, at most 10
};

/// Ours, beyond the paper's footnote: thin segments can cross without a point of one inside the
/// other. The contact of the axes of two segments, by the ranks at which they begin: empty where
/// they are farther apart than their radii, or nearest beyond an end. (Of axes that are almost
/// parallel it should not be asked: they have no one closest place, and their points find each
/// other.)
std::optional<AxisContact> axis_contact(const ContactPoints& points, std::uint32_t first,
                                        std::uint32_t second);

} // namespace mane
