/// The generator of random hair: its grooms fit together, its states are what they promise.

#include "reference/random_groom.h"
#include "reference/twin.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace mane;
using namespace mane::reference;

namespace {

bool finite(const Vec3d& a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

} // namespace

TEST_CASE("random grooms have an entry for every section, and mixed lengths") {
    std::set<std::uint32_t> lengths;
    for (std::uint32_t wisps = 1; wisps <= 33; ++wisps) {
        const RandomHair hair = {.seed = wisps, .wisps = wisps, .points = 3 + wisps % 6};
        const Groom groom = random_groom(hair);
        REQUIRE(groom.wisp_count() == wisps);
        REQUIRE(groom.first_section.back() == groom.section_count());
        for (std::size_t w = 0; w < wisps; ++w)
            lengths.insert(groom.sections(w));
        const std::size_t n = groom.section_count();
        for (const std::vector<float>* values :
             {&groom.skeleton_mass, &groom.envelope_mass, &groom.stretch_stiffness,
              &groom.stretch_damping, &groom.rest_length, &groom.bend_stiffness,
              &groom.bend_damping, &groom.rest_curvature_u, &groom.rest_curvature_v,
              &groom.radial_stiffness, &groom.radial_damping, &groom.ring_stiffness,
              &groom.ring_damping})
            CHECK(values->size() == n);
        for (const std::vector<float>* values :
             {&groom.radius, &groom.rest_radius, &groom.ring_length}) {
            CHECK(values->size() == n * hair.points);
            CHECK(*std::min_element(values->begin(), values->end()) > 0);
        }
    }
    CHECK(*lengths.begin() == 2);
    CHECK(*lengths.rbegin() == 33);
}

TEST_CASE("the same seed gives the same hair, another seed another") {
    const RandomHair hair = {.seed = 7, .wisps = 5, .points = 4};
    const Groom groom = random_groom(hair);
    CHECK(groom.position == random_groom(hair).position);
    CHECK(groom.position != random_groom({.seed = 8, .wisps = 5, .points = 4}).position);
    CHECK(random_state(hair, groom, 1).position == random_state(hair, groom, 1).position);
    CHECK(random_state(hair, groom, 1).position != random_state(hair, groom, 2).position);
}

TEST_CASE("random states hold zero radii, vanishing segments and sharp bends, and every "
          "acceleration is finite") {
    int zero_radii = 0, vanishing = 0;
    double sharpest = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const RandomHair hair = {
            .seed = seed, .wisps = 6, .points = static_cast<std::uint32_t>(3 + seed % 6)};
        const Groom groom = random_groom(hair);
        Hair twin(groom);
        set_state(twin, random_state(hair, groom, seed));
        for (const Wisp& wisp : twin.wisps) {
            const Accelerations a = accelerations(wisp, {.gravity = {0, -9.81, 0}, .air_drag = 3});
            for (std::size_t i = 0; i < wisp.sections(); ++i) {
                CHECK(finite(a.x[i]));
                for (std::size_t k = 0; k < wisp.points(); ++k) {
                    CHECK(std::isfinite(a.r[i][k]));
                    zero_radii += wisp.r[i][k] == 0;
                }
                if (i + 1 < wisp.sections())
                    vanishing += wisp.x[i] == wisp.x[i + 1];
                if (i > 0 && i + 1 < wisp.sections())
                    sharpest =
                        std::max(sharpest, std::acos(std::clamp(dot(segment_direction(wisp, i - 1),
                                                                    segment_direction(wisp, i)),
                                                                -1.0, 1.0)));
            }
        }
    }
    CHECK(zero_radii > 100);
    CHECK(vanishing > 20);
    CHECK(sharpest > 2.6);
    CHECK(sharpest < 2.97); // 170°
}
