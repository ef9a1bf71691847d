#include "motion_checks.h"

#include "mane/character.h"
#include "mane/error.h"

#include <cmath>

using namespace mane;

namespace {

using Channel = Clip::Channel;

// Hips that move and turn, and on them a straight chain chest, neck, head with the given names.
Clip make_clip(const std::vector<std::string>& names, std::uint32_t frames) {
    Clip clip;
    clip.source = "made.bvh";
    clip.frame_time = 1.0 / 60;
    clip.frame_count = frames;
    clip.joints.push_back(
        {"Hips",
         -1,
         {},
         {Channel::x_position, Channel::y_position, Channel::z_position, Channel::y_rotation},
         0});
    clip.channel_count = 4;
    for (const std::string& name : names) {
        const auto parent = static_cast<std::int32_t>(clip.joints.size()) - 1;
        clip.joints.push_back({name,
                               parent,
                               {0, 10, 0},
                               {Channel::z_rotation, Channel::x_rotation},
                               clip.channel_count});
        clip.channel_count += 2;
    }
    clip.joints.push_back(
        {"", static_cast<std::int32_t>(names.size()), {0, 5, 0}, {}, clip.channel_count});
    clip.values.assign(std::size_t{frames} * clip.channel_count, 0);
    return clip;
}

const std::vector<std::string> kCmu{"Spine1", "Neck1", "Head"};

double* frame(Clip& clip, std::uint32_t f) {
    return clip.values.data() + std::size_t{f} * clip.channel_count;
}

Vec3d head_joint(const BonePose* bones) {
    return bones[kHeadBone].position + bones[kHeadBone].rotation.rotate(bust_joints().head);
}

std::string error_of(const Clip& clip, const ClipMotionDesc& desc) {
    try {
        clip_motion(clip, desc);
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

} // namespace

TEST_CASE("a clip at rest puts the bust upright, its head joint on the clip's") {
    const Clip clip = make_clip(kCmu, 10);
    ClipMotionDesc desc;
    desc.unit = 0.05;
    BonePose bones[kBustBones];
    clip_motion(clip, desc)->evaluate(0.05, bones);
    for (const BonePose& bone : bones) {
        CHECK(length(bone.position - Vec3d(0, 1.5 - bust_joints().head.y, -bust_joints().head.z)) <
              1e-12);
        CHECK(bone.rotation.w == doctest::Approx(1));
        CHECK(length(bone.velocity) < 1e-12);
    }
}

TEST_CASE("a clip that walks and turns steadily is followed exactly: rotations are filtered "
          "without bias") {
    Clip clip = make_clip(kCmu, 240);
    for (std::uint32_t f = 0; f < 240; ++f) {
        frame(clip, f)[0] = 0.4 * f;                        // 0.4 × 0.05 m × 60 Hz = 1.2 m/s
        frame(clip, f)[3] = std::remainder(5.0 * f, 360.0); // 300 °/s, through several full turns
    }
    ClipMotionDesc desc;
    desc.unit = 0.05;
    desc.lowpass = 6;
    desc.first = 60;
    const auto motion = clip_motion(clip, desc);
    BonePose bones[kBustBones];
    for (double time : {-0.5, 0.0, 0.333, 1.0, 2.0}) {
        motion->evaluate(time, bones);
        CAPTURE(time);
        CHECK(length(head_joint(bones) - Vec3d(1.2 * (time + 1), 1.5, 0)) < 1e-9);
        const double yaw = 300 * (time + 1) * 3.14159265358979 / 180;
        // the spline through quaternions 2.5° apart errs with the fourth power of that
        for (const BonePose& bone : bones) {
            CHECK(length(bone.rotation.rotate({0, 0, 1}) - Vec3d(std::sin(yaw), 0, std::cos(yaw))) <
                  1e-6);
            CHECK(length(bone.angular_velocity - Vec3d(0, 300 * 3.14159265358979 / 180, 0)) < 1e-4);
        }
    }
}

TEST_CASE(
    "frames before `earliest` and after `last` are not used; the motion comes to rest beyond") {
    Clip clip = make_clip(kCmu, 100);
    for (std::uint32_t f = 0; f < 100; ++f)
        frame(clip, f)[2] = f;
    for (std::uint32_t f : {0u, 1u, 2u, 90u, 99u})
        frame(clip, f)[2] = 1e6; // a jump
    ClipMotionDesc desc;
    desc.unit = 0.05;
    desc.earliest = 3;
    desc.first = 20;
    desc.last = 89;
    const auto motion = clip_motion(clip, desc);
    BonePose bones[kBustBones];
    motion->evaluate(-17 / 60.0, bones);
    CHECK(head_joint(bones).z == doctest::Approx(3 * 0.05));
    CHECK(bones[kHeadBone].velocity.z == doctest::Approx(3));
    motion->evaluate(69 / 60.0, bones);
    CHECK(head_joint(bones).z == doctest::Approx(89 * 0.05));
    CHECK(bones[kHeadBone].velocity.z == doctest::Approx(3));
    for (double time : {-100.0, -17 / 60.0 - 0.51, 69 / 60.0 + 0.51, 100.0}) {
        motion->evaluate(time, bones);
        CHECK(length(bones[kHeadBone].velocity) == 0);
    }
    desc.first = 2; // earlier than `earliest`: then from here on
    clip_motion(clip, desc)->evaluate(0, bones);
    CHECK(head_joint(bones).z > 1e3);
}

TEST_CASE("a clip's motion has exact rates and is C² at frames, between them, and where it comes "
          "to rest") {
    Clip clip = make_clip(kCmu, 60);
    for (std::uint32_t f = 0; f < 60; ++f)
        for (std::uint32_t c = 0; c < clip.channel_count; ++c)
            frame(clip, f)[c] = 8 * std::sin(0.3 * f * (1 + 0.17 * c) + c);
    ClipMotionDesc desc;
    desc.unit = 0.02;
    desc.lowpass = 15;
    const auto motion = clip_motion(clip, desc);
    for (double time : {-0.4, -0.2, 0.004, 0.21, 0.3037, 0.777, 1.1, 1.4})
        check_rates(*motion, time);
    for (double time : {-0.5, 0.0, 10 / 60.0, 11 / 60.0, 30 / 60.0, 58 / 60.0, 58 / 60.0 + 0.5})
        check_smooth(*motion, time, 3e5);
}

TEST_CASE("the naming families are found, other names are set") {
    BonePose bones[kBustBones];
    for (const auto& names : {kCmu, {"Chest2", "Neck", "Head"}, {"chest", "neck", "head"}})
        clip_motion(make_clip(names, 5), {})->evaluate(0, bones);
    Clip clip = make_clip({"thorax", "cervix", "Head"}, 5);
    CHECK(error_of(clip, {}) ==
          "made.bvh: chest and head are not found by name, set them; the clip's joints are "
          "Hips, thorax, cervix, Head");
    ClipMotionDesc desc;
    desc.chest = "thorax";
    clip_motion(clip, desc)->evaluate(0, bones);
    desc.chest = "thorex";
    CHECK(error_of(clip, desc) ==
          "made.bvh: no joint \"thorex\"; the clip's joints are Hips, thorax, cervix, Head");
}

TEST_CASE("the neck turns by half of the head's turn on the chest, whatever the signs of their "
          "quaternions") {
    Clip clip = make_clip(kCmu, 30);
    for (std::uint32_t f = 0; f < 30; ++f) {
        frame(clip, f)[3] =
            200 + f;            // the chest's quaternion has a negative scalar part from 180° on
        frame(clip, f)[9] = 60; // the head nods
    }
    BonePose bones[kBustBones];
    clip_motion(clip, {})->evaluate(0.2, bones);
    const Quatd neck = bones[kChestBone].rotation.conjugate() * bones[kNeckBone].rotation;
    CHECK(std::fabs(neck.x) ==
          doctest::Approx(std::sin(15 * 3.14159265358979 / 180)).epsilon(1e-6));
    const Quatd head = bones[kNeckBone].rotation.conjugate() * bones[kHeadBone].rotation;
    CHECK(std::fabs(head.x) ==
          doctest::Approx(std::sin(15 * 3.14159265358979 / 180)).epsilon(1e-6));
    check_rates(*clip_motion(clip, {}), 0.21);
}

TEST_CASE("ranges, rates and units that cannot be used are refused") {
    const Clip clip = make_clip(kCmu, 10);
    ClipMotionDesc desc;
    desc.first = 10;
    CHECK(error_of(clip, desc) ==
          "made.bvh: frames 10 to 4294967295 of a clip of 10 frames, expected at least one");
    desc.first = 5;
    desc.last = 4;
    CHECK(error_of(clip, desc) ==
          "made.bvh: frames 5 to 4 of a clip of 10 frames, expected at least one");
    desc = {};
    desc.unit = 0;
    CHECK(error_of(clip, desc) == "made.bvh: unit is 0.000000, expected more than 0");
    desc = {};
    desc.fps = -1;
    CHECK(error_of(clip, desc) == "made.bvh: fps is -1.000000, expected more than 0");
    desc = {};
    desc.lowpass = NAN;
    CHECK(error_of(clip, desc) == "made.bvh: low-pass at nan Hz, expected 0 (none) or more");
    CHECK(error_of(make_clip(kCmu, 0), {}).find("of a clip of 0 frames") != std::string::npos);
}

TEST_CASE("a clip of one frame is a pose") {
    BonePose bones[kBustBones];
    ClipMotionDesc desc;
    desc.first = 0;
    clip_motion(make_clip(kCmu, 1), desc)->evaluate(3, bones);
    CHECK(length(bones[0].velocity) == 0);
}
