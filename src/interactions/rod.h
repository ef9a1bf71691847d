#pragma once

#include "interactions/contact_points.h"

namespace mane {

/// An endless round rod: all that is no farther than its radius from a line. A slender segment that
/// lies aslant fills little of its box; a rod about its axis tells that most of what is in the box
/// is not in its volume.
struct Rod {
    Vec3 x, way;      ///< the line: a point, and its direction, unit (zero: all of space)
    float radius = 0; ///< [m]
};

/// A rod that holds everything.
inline constexpr Rod kEverywhere{{}, {}, 1e6f};

/// Over all rounding in single precision, within metres of the origin [m].
inline constexpr float kRodMargin = 4e-6f;

/// No surface is farther from its axis [m] than that, at either end of the segment that begins at
/// `rank`.
float widest(const ContactPoints& points, std::uint32_t rank);

/// A rod that holds the volume of the segment that begins at `rank` (M21); docs/interactions.md has
/// the proof.
Rod volume_rod(const ContactPoints& points, std::uint32_t rank);

} // namespace mane
