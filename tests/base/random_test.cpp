#include "base/random.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace mane;

TEST_CASE("random numbers depend on seed, wisp, strand and index alone, and fill [0, 1) evenly") {
    CHECK(Random(1, 2, 3).unit(4) == Random(1, 2, 3).unit(4));
    CHECK(Random(1, 2, 3).bits(4) != Random(2, 2, 3).bits(4));
    CHECK(Random(1, 2, 3).bits(4) != Random(1, 3, 2).bits(4));
    CHECK(Random(1, 2, 3).bits(4) != Random(1, 2, 3).bits(5));

    const int n = 100000;
    double mean = 0, correlation = 0;
    for (int i = 0; i < n; ++i) {
        const double a = Random(7, static_cast<std::uint64_t>(i)).unit(0);
        const double b = Random(7, static_cast<std::uint64_t>(i) + 1).unit(0);
        CHECK((a >= 0 && a < 1));
        mean += a / n;
        correlation += (a - 0.5) * (b - 0.5) * 12 / n;
    }
    // four standard errors of n uniform numbers
    CHECK(std::fabs(mean - 0.5) < 4 * std::sqrt(1.0 / 12 / n));
    CHECK(std::fabs(correlation) < 4 / std::sqrt(double(n)));
}
