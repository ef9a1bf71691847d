#include "base/pack-inl.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

// Functions of Pack against the library's in double precision. One set of instructions: all give
// the same bits.

using namespace mane::HWY_NAMESPACE;

namespace {

float first_lane(Pack p) {
    alignas(64) float lanes[16];
    p.store(lanes);
    return lanes[0];
}

double relative_error(Pack found, double expected) {
    return std::fabs(double{first_lane(found)} / expected - 1);
}

} // namespace

TEST_CASE("1/√x: relative error under 2e-7 over two octaves and far off, finite at 0") {
    double largest = 0;
    for (const float scale : {1.f, 0x1p-80f, 0x1p80f})
        for (float x = 1; x < 4; x += 0x1p-14f) // each exponent's parity has all mantissas
            largest = std::max(largest, relative_error(inverse_square_root(Pack(x * scale)),
                                                       1 / std::sqrt(double{x * scale})));
    CHECK(largest < 2e-7);
    CHECK(largest > 2e-8);
    CHECK(std::isfinite(first_lane(inverse_square_root(Pack(0.f)))));
}

TEST_CASE("bend: relative error under 1e-6 from 0° to 180°, and its limits there") {
    double largest = 0;
    for (double degrees = 0.01; degrees < 180; degrees += 0.01) {
        const auto cosine = static_cast<float>(std::cos(degrees * std::numbers::pi / 360));
        const double c = double{cosine}, sine = std::sqrt((1 - c) * (1 + c));
        if (sine == 0)
            continue;
        const double half = std::atan2(sine, c), cotangent = half * c / sine;
        const Bend b = bend(Pack(cosine));
        largest = std::max({largest, relative_error(b.curvature, 2 * half / sine),
                            relative_error(b.cotangent, cotangent)});
        if (degrees > 0.5) // under that, 1 − q cancels even in double precision
            largest =
                std::max(largest, relative_error(b.remainder, (1 - cotangent) / (sine * sine)));
    }
    CHECK(largest < 1e-6);
    const Bend straight = bend(Pack(1.f)), folded = bend(Pack(0.f));
    CHECK(first_lane(straight.curvature) == doctest::Approx(2));
    CHECK(first_lane(straight.cotangent) == doctest::Approx(1));
    CHECK(first_lane(straight.remainder) == doctest::Approx(1.0 / 3));
    CHECK(first_lane(folded.curvature) == doctest::Approx(std::numbers::pi));
    CHECK(first_lane(folded.cotangent) == 0);
    CHECK(first_lane(folded.remainder) == doctest::Approx(1));
}
