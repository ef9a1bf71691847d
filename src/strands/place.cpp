#include "strands/place.h"

#include "base/functions.h"

#include <cmath>

namespace mane {
namespace {

// Each radius is the inverse of its distribution's closed-form share of the disc: one number per
// point, none rejected, so that a strand takes the same numbers of its generator whatever the
// distribution.
double radius_of(StrandDistribution distribution, double share) {
    switch (distribution) {
    case StrandDistribution::gaussian: {
        const double variance = kGaussianSpread * kGaussianSpread;
        const double inside = 1 - exponential(-0.5 / variance);
        return std::sqrt(-2 * variance * logarithm(1 - share * inside));
    }
    case StrandDistribution::rim:
        return std::sqrt(kRimInner * kRimInner + share * (1 - kRimInner * kRimInner));
    case StrandDistribution::uniform:
        break;
    }
    return std::sqrt(share);
}

} // namespace

DiscPoint place_in_disc(StrandDistribution distribution, const Random& random, std::uint64_t n) {
    const double r = radius_of(distribution, random.unit(n));
    const double angle = 2 * kPi * random.unit(n + 1);
    return {static_cast<float>(r * cosine(angle)), static_cast<float>(r * sine(angle))};
}

} // namespace mane
