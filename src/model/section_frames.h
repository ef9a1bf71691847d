#pragma once

#include "mane/vec.h"

#include <span>

namespace mane {

/// A section's own axes (§3.3, M8): right-handed, `normal` toward the tip.
template <typename T> struct SectionFrame {
    Vec3T<T> u;      ///< first axis: the direction of half line 0
    Vec3T<T> v;      ///< normal × u
    Vec3T<T> normal; ///< of the plane that bisects the two segments (M7)
};

/// The frames of all sections of one wisp, from its curve alone: no state is carried from frame to
/// frame, so a closed motion brings them back exactly. `position` (at least two points) and
/// `frames` have one entry per section; `first_axis` is across the wisp at its root. For everything
/// that reads stored frames; the step has the same equations over sixteen lanes.
template <typename T> void section_frames(std::span<const Vec3T<T>> position,
                                          const Vec3T<T>& first_axis,
                                          std::span<SectionFrame<T>> frames);

} // namespace mane
