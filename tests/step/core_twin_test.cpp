#include "base/random.h"
#include "instruction_sets.h"
#include "reference/random_groom.h"
#include "reference/twin.h"
#include "step/core_step.h"
#include "step/kernels.h"

#include "mane/error.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

// One step of the core against one step of the twin from the same random state, for every lane
// remainder, number of envelope points and instruction set.

using namespace mane;

namespace {

/// How far rounding of the inputs alone moves the twin's answer: positions and radii of decimetres
/// have a half unit in the last place of 3e-8 m. The core rounds about as often again in between,
/// in each of some tens of operations.
struct Noise {
    std::vector<double> x, r;
};
Noise rounding_noise(const reference::Wisp& wisp, const reference::Surroundings& around) {
    const reference::Accelerations exact = accelerations(wisp, around);
    Noise noise{std::vector<double>(wisp.sections()), std::vector<double>(wisp.sections())};
    for (std::uint64_t trial = 0; trial < 4; ++trial) {
        const Random random(trial, 7);
        reference::Wisp moved = wisp;
        std::uint64_t n = 0;
        const auto nudge = [&](double& value, double relative) {
            const double share = 2.0 * random.unit(n++) - 1.0;
            value += share * (6e-8 + relative * std::fabs(value));
        };
        for (std::size_t i = 0; i < wisp.sections(); ++i) {
            for (double* c : {&moved.x[i].x, &moved.x[i].y, &moved.x[i].z})
                nudge(*c, 6e-8);
            for (double* c : {&moved.v[i].x, &moved.v[i].y, &moved.v[i].z})
                nudge(*c, 2e-7);
            for (double& r : moved.r[i])
                nudge(r, 6e-8);
            for (double& r : moved.r_rate[i])
                nudge(r, 2e-7);
        }
        const reference::Accelerations a = accelerations(moved, around);
        for (std::size_t i = 0; i < wisp.sections(); ++i) {
            noise.x[i] = std::max(noise.x[i], length(a.x[i] - exact.x[i]));
            for (std::size_t e = 0; e < wisp.points(); ++e)
                noise.r[i] = std::max(noise.r[i], std::fabs(a.r[i][e] - exact.r[i][e]));
        }
    }
    return noise;
}

} // namespace

TEST_CASE("one step of forces equals the twin's, for every lane remainder, K and bend") {
    const Kernels kernels = kernels_for("");
    std::uint64_t seed = 0;
    for (std::uint32_t points : {3u, 4u, 5u, 6u, 8u}) {
        for (std::uint32_t wisps = 1; wisps <= 33; wisps += points == 4 ? 1 : 8) {
            reference::RandomHair description;
            description.seed = ++seed;
            description.wisps = wisps;
            description.points = points;
            const Groom groom = random_groom(description);
            const Frame frame = random_state(description, groom, seed + 1000);
            CoreStep core(groom);
            core.take(frame);
            kernels.process_forces(core.data(), 0, core.layout.packets().size());

            const reference::Hair twin = twin_of(groom, frame);
            const reference::Surroundings around{
                .gravity = {double{0.3f}, double{-9.81f}, double{0.1f}}, .air_drag = 3};
            for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
                const reference::Accelerations a = accelerations(twin.wisps[w], around);
                const Noise noise = rounding_noise(twin.wisps[w], around);
                for (std::uint32_t i = 2; i < groom.sections(w); ++i) {
                    const std::uint32_t s = groom.first_section[w] + i;
                    const Slot slot = core.layout.slot(s);
                    // v' = v + h a rounds once more, at the size of v'
                    const Vec3d moved = Vec3d(frame.velocity[s]) + a.x[i] * double{kStep};
                    const double allowed = kStep * (8 * noise.x[i] + 1e-5 * length(a.x[i])) +
                                           2e-7 * (length(moved) + 1);
                    CHECK(length(Vec3d(core.state.velocity.vec(slot)) - moved) <= allowed);
                    for (std::uint32_t e = 0; e < points; ++e) {
                        const double rate = frame.radius_rate[s * points + e] + kStep * a.r[i][e];
                        const double allowed_rate =
                            kStep * (8 * noise.r[i] + 1e-5 * std::fabs(a.r[i][e])) +
                            2e-7 * (std::fabs(rate) + 1);
                        CHECK(std::fabs(core.state.radius_rate.at(slot, e) - rate) <= allowed_rate);
                    }
                }
            }
        }
    }
}

TEST_CASE("every instruction set gives the same bits, step after step") {
    reference::RandomHair description;
    description.seed = 5;
    description.wisps = 37;
    description.vanishing = true;
    for (std::uint32_t points : {3u, 4u, 7u}) {
        description.points = points;
        const Groom groom = random_groom(description);
        const Frame frame = random_state(description, groom, 6);
        std::vector<float> expected;
        for (const auto& [set, kernels] : test::on_all_sets(
                 [](const std::string& name) { return std::pair(name, kernels_for(name)); })) {
            CHECK(std::string(kernels.instruction_set) == set);
            CoreStep core(groom);
            core.take(frame);
            for (int i = 0; i < 20; ++i) {
                kernels.process_forces(core.data(), 0, core.layout.packets().size());
                kernels.process_positions(core.data(), 0.5f, 0, core.layout.packets().size());
            }
            std::vector<float> all;
            for (const Rows* rows : {&core.state.position, &core.state.velocity, &core.state.radius,
                                     &core.state.radius_rate})
                all.insert(all.end(), rows->all().begin(), rows->all().end());
            if (expected.empty())
                expected = all;
            std::size_t different = 0;
            for (std::size_t i = 0; i < all.size(); ++i)
                different += std::bit_cast<std::uint32_t>(all[i]) !=
                             std::bit_cast<std::uint32_t>(expected[i]);
            CHECK(different == 0);
        }
    }
}

TEST_CASE("an instruction set that is not there is an input error that names those that are") {
    CHECK_THROWS_WITH_AS(kernels_for("mmx"), doctest::Contains("scalar"), InputError);
}
