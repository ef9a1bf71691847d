/// A single wisp comes to rest as its air and bending damping say.
///
/// Closed form. Small sideways motion x_i(t) of a wisp that hangs straight: with the section masses
/// m_i, the tensions T_i (the weight below segment i), the joints' stiffnesses k_i and dampings
/// c_i, and the bend θ_i = (x_{i+1} − x_i)/l_i − (x_i − x_{i−1})/l_{i−1},
///
///     ½ ẋᵀMẋ = ½ Σ m_i ẋ_i²        ½ xᵀKx = ½ Σ T_i (x_{i+1} − x_i)²/l_i + ½ Σ k_i θ_i²
///     ½ ẋᵀCẋ = ½ c_a Σ m_i ẋ_i² + ½ Σ c_i θ̇_i²     (half of the power lost)
///
/// In the first mode φ, Kφ = ω² Mφ, the amplitude falls as e^{−γt} with
///
///     γ = φᵀCφ / 2φᵀMφ = c_a/2 + Σ c_i θ_i(φ)² / 2φᵀMφ
///
/// (to first order in C, which couples modes at second order), so that from one maximum to the next
/// on the same side it falls by the decrement δ = 2πγ/√(ω² − γ²). What is left out: the envelope
/// follows at 256 rad/s, and the step adds or takes h ω²/2 at most: 2 % of γ here.

#include "step/lone_wisp.h"
#include "step/small_motion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace mane;

namespace {

/// Logarithm of the ratio of two swings a period apart, over `half_swings` half swings of the first
/// mode.
double measured_decrement(const LoneWisp& wisp, const SmallMotion& motion, int half_swings) {
    World world = wisp.world();
    while (world.frame().time <= Nudge::kSeconds)
        world.advance();
    std::vector<double> extremes;
    double a = motion.first_mode(world.frame()), b = a;
    while (static_cast<int>(extremes.size()) <= half_swings) {
        world.advance();
        const double c = motion.first_mode(world.frame());
        if ((b - a) * (c - b) < 0) // the top of the parabola through three frames
            extremes.push_back(std::abs(b - (c - a) * (c - a) / (8 * (a - 2 * b + c))));
        a = b;
        b = c;
        REQUIRE(world.frame().time < 10);
    }
    return 2 * std::log(extremes.front() / extremes.back()) / half_swings;
}

} // namespace

TEST_CASE("a wisp's logarithmic decrement is that of its air and bending damping") {
    struct Damping {
        float air, bending;
    };
    for (const Damping& damping : {Damping{3, 0.3f}, {3, 0}, {0, 0.3f}, {1, 0.1f}}) {
        LoneWisp wisp;
        wisp.desc.air.drag = damping.air;
        wisp.shape.skeleton.bending_damping = damping.bending;
        wisp.shape.skeleton.bending_length = 0.2f; // so that bending has its part in the mode
        wisp.desc.schedule.integration_rate = 4000;
        const Groom groom = wisp.groom();
        const SmallMotion motion(groom);
        const double decay = double{damping.air} / 2 + motion.bending_decay();
        const double omega = motion.frequency();
        const double expected =
            2 * std::numbers::pi * decay / std::sqrt(omega * omega - decay * decay);
        const double found = measured_decrement(wisp, motion, 4);
        MESSAGE("air " << damping.air << " /s, bending " << damping.bending << ": decrement "
                       << found << ", closed form " << expected << " (of it bending "
                       << 100 * motion.bending_decay() / decay << " %)");
        CHECK(found == doctest::Approx(expected).epsilon(0.1));
    }
}
