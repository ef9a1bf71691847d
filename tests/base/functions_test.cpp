#include "base/functions.h"
#include "base/random.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace mane;

TEST_CASE("own transcendental functions agree with the library's within their stated errors") {
    const Random random(1, 2);
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const double x = (random.unit(2 * i) - 0.5) * 200.0;
        const double y = (random.unit(2 * i + 1) - 0.5) * 200.0;
        CHECK(std::fabs(sine(x) - std::sin(x)) < 1e-14);
        CHECK(std::fabs(cosine(x) - std::cos(x)) < 1e-14);
        CHECK(std::fabs(arc_tangent(y, x) - std::atan2(y, x)) < 1e-14);
        CHECK(std::fabs(exponential(x) / std::exp(x) - 1) < 1e-13);
        const double c = x / 100.0;
        CHECK(std::fabs(arc_cosine(c) - std::acos(c)) < 2e-14);
        const double p = std::fabs(y) / 25.0, base = std::fabs(x) + 1e-6;
        CHECK(std::fabs(logarithm(base) - std::log(base)) <
              1e-14 * (1 + std::fabs(std::log(base))));
        CHECK(std::fabs(power(base, p) / std::pow(base, p) - 1) < 1e-12);
        CHECK(std::fabs(cube_root(x) - std::cbrt(x)) < 1e-12 * (1 + std::fabs(x)));
    }
}

TEST_CASE("arc tangent and cosine at the ends of their ranges") {
    CHECK(arc_tangent(0, 1) == 0);
    CHECK(arc_tangent(0, -1) == doctest::Approx(kPi));
    CHECK(arc_tangent(1, 0) == doctest::Approx(kPi / 2));
    CHECK(arc_cosine(1.0) == 0);
    CHECK(arc_cosine(-1.0) == doctest::Approx(kPi));
    CHECK(arc_cosine(7.0) == 0);
}
