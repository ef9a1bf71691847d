#include "motion_checks.h"

#include "mane/character.h"
#include "mane/error.h"

#include <cmath>

using namespace mane;

namespace {

Vec3d head_joint(const BonePose* bones) {
    return bones[kHeadBone].position + bones[kHeadBone].rotation.rotate(bust_joints().head);
}
Vec3d head_velocity(const BonePose* bones) {
    const BonePose& head = bones[kHeadBone];
    return head.velocity + cross(head.angular_velocity, head.rotation.rotate(bust_joints().head));
}

} // namespace

TEST_CASE("the built-in motion starts and ends in the rest pose, at rest") {
    const auto motion = builtin_motion();
    BonePose bones[kBustBones];
    for (double time : {-2.0, 0.0, 11.0, 20.0}) {
        motion->evaluate(time, bones);
        for (const BonePose& bone : bones) {
            CHECK(length(bone.position) < 1e-12);
            CHECK(std::fabs(bone.rotation.w) == doctest::Approx(1).epsilon(1e-12));
            CHECK(length(bone.velocity) < 1e-12);
            CHECK(length(bone.angular_velocity) < 1e-12);
        }
    }
}

TEST_CASE("the built-in motion's rates are its derivatives, and nothing jumps, at any time") {
    const auto motion = builtin_motion();
    for (int k = -5; k < 1150; ++k) {
        const double time = k * 0.01;
        check_rates(*motion, time + 0.0037);
        check_smooth(*motion, time, 6000); // all pieces begin and end at multiples of 0.05 s
    }
}

TEST_CASE("the built-in motion is as fast as the captured ones, and whirls all around") {
    const auto motion = builtin_motion();
    BonePose bones[kBustBones];
    double speed = 0, turning = 0, still = 0, yaw = 0;
    for (int k = 0; k <= 11000; ++k) {
        motion->evaluate(k * 0.001, bones);
        speed = std::max(speed, length(head_velocity(bones)));
        turning = std::max(turning, length(bones[kHeadBone].angular_velocity));
        yaw += bones[kChestBone].angular_velocity.y * 0.001;
        still += length(bones[kHeadBone].angular_velocity) < 0.3 ? 0.001 : 0;
        CHECK(length(head_joint(bones) - Vec3d(0, 1.4, 0)) < 0.6);
    }
    CAPTURE(speed);
    CAPTURE(turning);
    CAPTURE(still);
    CHECK((speed > 1 && speed < 2.5));
    CHECK((turning > 5 && turning < 12));
    CHECK(std::fabs(yaw) > 6.2);
    CHECK((still > 0.5 && still < 3)); // pauses
}

TEST_CASE("a frozen motion is the same until then, C² where it slows, and at rest after") {
    const auto motion = builtin_motion();
    const auto frozen = frozen_motion(motion, 7.9, 0.25);
    BonePose a[kBustBones], b[kBustBones];
    motion->evaluate(7.8, a);
    frozen->evaluate(7.8, b);
    CHECK(a[2].position == b[2].position);
    CHECK(a[2].angular_velocity == b[2].angular_velocity);
    for (double time : {7.9, 8.0, 8.15})
        check_smooth(*frozen, time, 60000);
    for (double time : {7.93, 8.0, 8.1, 8.3})
        check_rates(*frozen, time);
    frozen->evaluate(8.15, a);
    frozen->evaluate(100, b);
    CHECK(a[2].position == b[2].position);
    CHECK(length(b[2].velocity) == 0);
    CHECK(length(b[2].angular_velocity) == 0);
    CHECK_THROWS_AS(frozen_motion(motion, 1, 0), InputError);
    CHECK_THROWS_AS(frozen_motion(motion, NAN, 1), InputError);
}
