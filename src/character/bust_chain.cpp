#include "character/bust_chain.h"

namespace mane {
namespace {

PointMotion point_on(const BonePose& bone, const Vec3d& rest) {
    const Vec3d arm = bone.rotation.rotate(rest);
    return {bone.position + arm, bone.velocity + cross(bone.angular_velocity, arm)};
}

} // namespace

BonePose bone_through(const Vec3d& rest, const PointMotion& point, const Turning& turning) {
    const Vec3d arm = turning.rotation.rotate(rest);
    return {point.position - arm, turning.rotation,
            point.velocity - cross(turning.angular_velocity, arm), turning.angular_velocity};
}

void pose_from_chest(const BustJoints& joints, const PointMotion& chest, const BustTurning& turning,
                     std::span<BonePose> bones) {
    const BonePose chest_bone = bone_through(joints.chest, chest, turning[kChestBone]);
    const BonePose neck_bone =
        bone_through(joints.neck, point_on(chest_bone, joints.neck), turning[kNeckBone]);
    bones[kChestBone] = chest_bone;
    bones[kNeckBone] = neck_bone;
    bones[kHeadBone] =
        bone_through(joints.head, point_on(neck_bone, joints.head), turning[kHeadBone]);
}

void pose_from_head(const BustJoints& joints, const PointMotion& head, const BustTurning& turning,
                    std::span<BonePose> bones) {
    const BonePose neck_bone = bone_through(joints.head, head, turning[kNeckBone]);
    bones[kHeadBone] = bone_through(joints.head, head, turning[kHeadBone]);
    bones[kNeckBone] = neck_bone;
    bones[kChestBone] =
        bone_through(joints.neck, point_on(neck_bone, joints.neck), turning[kChestBone]);
}

} // namespace mane
