#pragma once

#include "base/random.h"
#include "mane/desc.h"

namespace mane {

/// A point of the unit disc that stands for a wisp's cross-section.
struct DiscPoint {
    float x = 0;
    float y = 0;
};

/// Where a strand stands in its wisp's cross-section (§5.2, M16), from the numbers `n` and `n + 1`
/// of `random`.
DiscPoint place_in_disc(StrandDistribution distribution, const Random& random, std::uint64_t n);

/// Standard deviation, per axis, of the Gaussian before it is cut at the rim.
inline constexpr double kGaussianSpread = 0.4;
/// Strands of the rim distribution stand between this radius and 1.
inline constexpr double kRimInner = 0.8;

} // namespace mane
