#include "motion_checks.h"

#include "base/random.h"
#include "mane/driven.h"
#include "mane/error.h"

#include <cmath>
#include <limits>

using namespace mane;

namespace {

constexpr double kFrame = 1.0 / 24; // [s]

/// Poses as a shaking hand gives them: each a little anywhere from the one before.
std::vector<HeadPose> jerky_poses(std::size_t count) {
    const Random random(11, 4);
    std::vector<HeadPose> poses;
    HeadPose pose{bust_joints().head, {}, {}};
    for (std::uint64_t n = 0; n < count; ++n) {
        const auto at = [&](std::uint64_t k) { return double{random.between(16 * n + k, -1, 1)}; };
        pose.position += Vec3d(at(0), at(1), at(2)) * 0.02;
        pose.rotation = normalized(Quatd{at(3), at(4), at(5), 4} * pose.rotation);
        pose.chest = normalized(Quatd{at(6), at(7), at(8), 9} * pose.chest);
        poses.push_back(pose);
    }
    return poses;
}

/// The same rotation, whatever the signs.
double angle_between(const Quatd& a, const Quatd& b) {
    const Quatd q = a * b.conjugate();
    return 2 * length(Vec3d(q.x, q.y, q.z));
}

BonePose bone_at(const Motion& motion, double time, std::uint32_t bone = 0) {
    std::vector<BonePose> bones(motion.bone_count());
    motion.evaluate(time, bones);
    return bones[bone];
}

} // namespace

TEST_CASE("a led bust is where it was led at each frame's end, C² on the way, however jerky") {
    const BustJoints joints = bust_joints();
    DrivenBust bust;
    const std::vector<HeadPose> poses = jerky_poses(40);
    for (std::size_t n = 0; n < poses.size(); ++n) {
        const double from = static_cast<double>(n) * kFrame, to = from + kFrame;
        const BonePose head = bone_at(bust, from, kHeadBone);
        bust.move_to(poses[n], from, to);
        const BonePose same = bone_at(bust, from, kHeadBone); // the way goes on from there
        CHECK(length(same.position - head.position) < 1e-13);
        CHECK(length(same.velocity - head.velocity) < 1e-11);
        CHECK(length(same.angular_velocity - head.angular_velocity) < 1e-11);

        const HeadPose there = head_pose(bust, to);
        CHECK(length(there.position - poses[n].position) < 1e-13);
        CHECK(angle_between(there.rotation, poses[n].rotation) < 1e-13);
        CHECK(angle_between(there.chest, poses[n].chest) < 1e-13);
        for (double s : {0.1, 0.4, 0.77})
            check_rates(bust, from + s * kFrame);
        check_smooth(bust, to, 4e5); // from one stretch to the rest that follows it
        // all bones hang together, the neck halfway
        std::vector<BonePose> bones(kBustBones);
        bust.evaluate(from + 0.3 * kFrame, bones);
        const auto at = [&](std::uint32_t bone, const Vec3d& p) {
            return bones[bone].rotation.rotate(p) + bones[bone].position;
        };
        CHECK(length(at(kHeadBone, joints.head) - at(kNeckBone, joints.head)) < 1e-13);
        CHECK(length(at(kNeckBone, joints.neck) - at(kChestBone, joints.neck)) < 1e-13);
        CHECK(angle_between(bones[kHeadBone].rotation, bones[kNeckBone].rotation) ==
              doctest::Approx(angle_between(bones[kNeckBone].rotation, bones[kChestBone].rotation))
                  .epsilon(1e-9));
    }
}

TEST_CASE("no jump of acceleration where a host leads on") {
    // The frame before, as it was led then, ends with the acceleration with which the next begins.
    const std::vector<HeadPose> poses = jerky_poses(12);
    DrivenBust bust;
    constexpr double kMoment = 1e-6;
    for (std::size_t n = 0; n < poses.size(); ++n) {
        const double from = static_cast<double>(n) * kFrame;
        const BonePose before = bone_at(bust, from - kMoment, kHeadBone);
        bust.move_to(poses[n], from, from + kFrame);
        const BonePose now = bone_at(bust, from, kHeadBone),
                       after = bone_at(bust, from + kMoment, kHeadBone);
        const Vec3d into = (now.velocity - before.velocity) / kMoment,
                    out = (after.velocity - now.velocity) / kMoment;
        // rounding of velocities of about 1 m/s, and 1e-6 s of a jerk of some 1e5 m/s³
        CHECK(length(into - out) < 0.5);
        const Vec3d turn_in = (now.angular_velocity - before.angular_velocity) / kMoment,
                    turn_out = (after.angular_velocity - now.angular_velocity) / kMoment;
        CHECK(length(turn_in - turn_out) < 3);
    }
}

TEST_CASE("no acceleration is over four times the second difference of the poses") {
    DrivenMotion motion;
    const Random random(3, 3);
    std::vector<Vec3d> given = {{}, {}};
    double highest_share = 0;
    for (std::uint64_t n = 0; n < 50; ++n) {
        const double from = static_cast<double>(n) * kFrame;
        const Vec3d p(double{random.between(4 * n, -1, 1)},
                      double{random.between(4 * n + 1, -1, 1)}, 0);
        const Vec3d second = p - given.back() * 2 + given[given.size() - 2];
        given.push_back(p);
        motion.move_to({p, {}}, from, from + kFrame);
        const double bound = 4 * length(second) / (kFrame * kFrame);
        for (int i = 1; i < 100; ++i) {
            const double time = from + i * kFrame / 100, h = kFrame / 1000;
            const Vec3d a =
                (bone_at(motion, time + h).velocity - bone_at(motion, time - h).velocity) / (2 * h);
            CHECK(length(a) < bound);
            highest_share = std::max(highest_share, length(a) / bound);
        }
    }
    CHECK(highest_share > 0.9); // 3.94 of 4: the bound is no empty one
}

TEST_CASE("a steady way stays steady") {
    // A wheel that turns and rolls: from the second frame on its speeds are those of the poses.
    const Vec3d hub(0.3, 1, 0);
    DrivenMotion motion(DrivenMotion::Bone{{}, hub});
    const double turn = 0.2; // [rad] per frame
    const auto pose_at = [&](int n) {
        const Quatd q{std::sin(turn * n / 2), 0, 0, std::cos(turn * n / 2)};
        return Pose{hub + Vec3d(0.01 * n, 0, 0) - q.rotate(hub), q};
    };
    for (int n = 1; n < 30; ++n) {
        const double from = (n - 1) * kFrame;
        motion.move_to(pose_at(n), from, from + kFrame);
        for (double s : {0.0, 0.2, 0.5, 0.9}) {
            const BonePose now = bone_at(motion, from + s * kFrame);
            if (n < 2)
                continue;
            const Vec3d hub_velocity =
                now.velocity + cross(now.angular_velocity, now.rotation.rotate(hub));
            CHECK(length(hub_velocity - Vec3d(0.01 / kFrame, 0, 0)) < 1e-11);
            CHECK(length(now.angular_velocity - Vec3d(turn / kFrame, 0, 0)) < 1e-10);
        }
    }
}

TEST_CASE("a host that stops leading leaves the body where it led it last, at rest a frame later") {
    DrivenMotion motion;
    motion.move_to({{0.1, 0, 0}, {0, 0.6, 0, 0.8}}, 1, 1 + kFrame);
    const double end = 1 + kFrame;
    CHECK(length(bone_at(motion, end).velocity) == doctest::Approx(0.1 / kFrame));
    check_rates(motion, end + 0.3 * kFrame);
    check_smooth(motion, end + kFrame, 4e5);
    const BonePose rest = bone_at(motion, end + 1.01 * kFrame);
    CHECK(rest.position == Vec3d(0.1, 0, 0));
    CHECK(rest.velocity == Vec3d());
    CHECK(rest.angular_velocity == Vec3d());
    // it does not fly on: less than a fifth of the last frame's way
    for (double s : {0.2, 0.4, 0.6, 0.8})
        CHECK(std::fabs(bone_at(motion, end + s * kFrame).position.x - 0.1) < 0.1 / 5);
}

TEST_CASE("a jump takes the whole motion along, and a jump by nothing changes no bit") {
    DrivenBust bust, jumped;
    const std::vector<HeadPose> poses = jerky_poses(6);
    for (std::size_t n = 0; n < poses.size(); ++n) {
        const double from = static_cast<double>(n) * kFrame;
        bust.move_to(poses[n], from, from + kFrame);
        jumped.move_to(poses[n], from, from + kFrame);
    }
    const double time = 5.6 * kFrame;
    std::vector<BonePose> before(kBustBones), after(kBustBones);
    bust.evaluate(time, before);
    jumped.jump({});
    jumped.evaluate(time, after);
    CHECK(before == after);

    const Pose by{{3, -2, 1}, normalized(Quatd{0.3, 1, -0.2, 0.5})};
    jumped.jump(by);
    jumped.evaluate(time, after);
    for (std::size_t b = 0; b < kBustBones; ++b) {
        const auto& [p, q, v, w] = before[b];
        CHECK(length(after[b].position - (by.rotation.rotate(p) + by.position)) < 1e-14);
        CHECK(angle_between(after[b].rotation, by.rotation * q) < 1e-14);
        CHECK(length(after[b].velocity - by.rotation.rotate(v)) < 1e-12);
        CHECK(length(after[b].angular_velocity - by.rotation.rotate(w)) < 1e-12);
    }
    CHECK(length(jumped.target().position -
                 (by.rotation.rotate(poses.back().position) + by.position)) < 1e-14);
}

TEST_CASE("bad poses and times are refused, and the motion stays as it was") {
    DrivenMotion motion;
    motion.move_to({{0.1, 0, 0}, {}}, 0, kFrame);
    const BonePose before = bone_at(motion, 0.02);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_WITH_AS(motion.move_to({{nan, 0, 0}, {}}, kFrame, 2 * kFrame),
                         "a pose whose position is not finite", InputError);
    CHECK_THROWS_WITH_AS(motion.move_to({{}, {0, 0, 0, 0}}, kFrame, 2 * kFrame),
                         "a pose whose rotation is not finite or the zero quaternion", InputError);
    CHECK_THROWS_WITH_AS(motion.move_to(Pose{}, 2, 2),
                         "a motion led from 2.000000 s to 2.000000 s; expected a time after the "
                         "first",
                         InputError);
    const Pose two[2];
    CHECK_THROWS_WITH_AS(motion.move_to(two, 1, 2), "2 poses for a motion of 1 bones", InputError);
    CHECK_THROWS_AS(motion.jump({{0, nan, 0}, {}}), InputError);
    CHECK(bone_at(motion, 0.02) == before);
    CHECK_THROWS_WITH_AS(DrivenMotion(std::span<const DrivenMotion::Bone>{}),
                         "a driven motion of no bones; expected at least one", InputError);
}
