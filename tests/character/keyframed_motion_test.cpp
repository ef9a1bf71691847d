#include "motion_checks.h"

#include "mane/character.h"
#include "mane/error.h"

#include <cmath>

using namespace mane;

TEST_CASE("a keyframed motion passes through its keys, C², at rest before and after") {
    const double h = std::sqrt(0.5);
    const auto motion =
        keyframed_motion({{1, {0, 0, 0}, {}},
                          {1.5, {0.2, 0, 0}, {0, -h, 0, -h}}, // a quarter turn, the other sign
                          {2.5, {0.2, 0.3, 0}, {0, 2, 0, 0}}, // half a turn, not normalised
                          {3, {0, 0.3, 0.5}, {0, 1, 0, 0}}});
    BonePose bone[1];
    motion->evaluate(1.5, bone);
    CHECK(length(bone[0].position - Vec3d(0.2, 0, 0)) < 1e-12);
    CHECK(length(bone[0].rotation.rotate({1, 0, 0}) - Vec3d(0, 0, -1)) < 1e-12);
    CHECK(dot(bone[0].rotation, bone[0].rotation) == doctest::Approx(1).epsilon(1e-14));
    motion->evaluate(9, bone);
    CHECK(bone[0].position == Vec3d(0, 0.3, 0.5));
    CHECK(length(bone[0].velocity) == 0);
    for (double time : {0.9, 1.1, 1.4, 1.7, 2.2, 2.6, 2.9, 3.1})
        check_rates(*motion, time);
    for (double time : {1.0, 1.5, 2.5, 3.0})
        check_smooth(*motion, time, 3000);
}

TEST_CASE("one key is a place") {
    BonePose bone[1];
    keyframed_motion({{5, {1, 2, 3}, {}}})->evaluate(0, bone);
    CHECK(bone[0].position == Vec3d(1, 2, 3));
    CHECK(length(bone[0].velocity) == 0);
}

TEST_CASE("bad keys are refused by number") {
    CHECK_THROWS_WITH_AS(keyframed_motion({}), "keyframed motion: no keys, expected at least one",
                         InputError);
    CHECK_THROWS_WITH_AS(
        keyframed_motion({{1, {}, {}}, {1, {}, {}}}),
        "keyframed motion, key 1: time 1.000000 s after 1.000000 s, expected rising times",
        InputError);
    CHECK_THROWS_WITH_AS(keyframed_motion({{1, {NAN, 0, 0}, {}}}),
                         "keyframed motion, key 0: not finite", InputError);
    CHECK_THROWS_WITH_AS(keyframed_motion({{1, {}, {0, 0, 0, 0}}}),
                         "keyframed motion, key 0: the rotation is the zero quaternion",
                         InputError);
}
