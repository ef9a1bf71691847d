#include "strands/place.h"

#include <cmath>
#include <doctest/doctest.h>

using namespace mane;

namespace {

struct Moments {
    double x = 0, y = 0, xy = 0, r2 = 0, inner = 0, largest = 0;
};

constexpr int kPoints = 40000;

Moments moments(StrandDistribution distribution) {
    Moments m;
    for (int i = 0; i < kPoints; ++i) {
        const DiscPoint p =
            place_in_disc(distribution, Random(7, 3, static_cast<std::uint64_t>(i)), 0);
        const double r2 = double{p.x} * p.x + double{p.y} * p.y;
        m.x += p.x, m.y += p.y, m.xy += double{p.x} * p.y, m.r2 += r2, m.inner += r2 < 0.25;
        m.largest = std::max(m.largest, std::sqrt(r2));
    }
    for (double* sum : {&m.x, &m.y, &m.xy, &m.r2, &m.inner})
        *sum /= kPoints;
    return m;
}

// Four standard errors of a mean of values within [−1, 1].
const double kTolerance = 4 / std::sqrt(double{kPoints});

void check(StrandDistribution distribution, double mean_r2, double share_inside_half) {
    const Moments m = moments(distribution);
    CHECK(std::abs(m.x) < kTolerance);
    CHECK(std::abs(m.y) < kTolerance);
    CHECK(std::abs(m.xy) < kTolerance);
    CHECK(std::abs(m.r2 - mean_r2) < kTolerance);
    CHECK(std::abs(m.inner - share_inside_half) < kTolerance);
    CHECK(m.largest <= 1 + 1e-6);
    CHECK(m.largest > 0.98);
}

} // namespace

TEST_CASE("places: uniform over the disc") {
    check(StrandDistribution::uniform, 0.5, 0.25);
}

TEST_CASE("places: a Gaussian cut at the rim") {
    const double variance = kGaussianSpread * kGaussianSpread, a = 0.5 / variance;
    const double inside = 1 - std::exp(-a);
    check(StrandDistribution::gaussian, 2 * variance * (1 - a * std::exp(-a) / inside),
          (1 - std::exp(-0.25 * a)) / inside);
}

TEST_CASE("places: uniform over the rim's ring") {
    check(StrandDistribution::rim, (1 + kRimInner * kRimInner) / 2, 0);
}
