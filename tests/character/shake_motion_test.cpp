#include "motion_checks.h"

#include "mane/character.h"
#include "mane/error.h"

#include <cmath>
#include <limits>
#include <numbers>

using namespace mane;

namespace {

constexpr double kAngle = 40 * std::numbers::pi / 180, kRate = 1.5;

/// How far a bone is turned to the left [rad]; it may turn about no other axis.
double yaw(const BonePose& bone) {
    CHECK(std::fabs(bone.rotation.x) < 1e-15);
    CHECK(std::fabs(bone.rotation.z) < 1e-15);
    return 2 * std::atan2(bone.rotation.y, bone.rotation.w);
}

} // namespace

TEST_CASE("the head shakes as a sine, the neck by half of it, on a chest at rest") {
    const auto motion = shake_motion(kAngle, kRate);
    BonePose bones[kBustBones];
    for (double time = -2; time < 2; time += 0.0371) {
        CAPTURE(time);
        motion->evaluate(time, bones);
        const double angle = kAngle * std::sin(2 * std::numbers::pi * kRate * time);
        CHECK(yaw(bones[kHeadBone]) == doctest::Approx(angle).epsilon(1e-12));
        CHECK(yaw(bones[kNeckBone]) == doctest::Approx(angle / 2).epsilon(1e-12));
        CHECK(yaw(bones[kChestBone]) == 0);
        CHECK(length(bones[kChestBone].velocity) == 0);
        check_rates(*motion, time);
        check_smooth(*motion, time, 1000);
    }
}

TEST_CASE("a shake needs a rate") {
    for (double rate : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        CHECK_THROWS_AS(shake_motion(kAngle, rate), InputError);
    CHECK_THROWS_AS(shake_motion(std::numeric_limits<double>::infinity(), 1), InputError);
}
