#include "character/led.h"

#include <array>

namespace mane {
namespace {

TrackPoint<4> quaternion_of(const Turning& turning) {
    const auto& [q, w] = turning;
    const Quatd rate = Quatd{w.x / 2, w.y / 2, w.z / 2, 0} * q;
    return {{q.x, q.y, q.z, q.w}, {rate.x, rate.y, rate.z, rate.w}};
}

/// The neck is turned halfway between chest and head.
Turning halfway(const Turning& chest, const Turning& head) {
    const TrackPoint<4> a = quaternion_of(chest), b = quaternion_of(head);
    const double sign = dot(chest.rotation, head.rotation) < 0 ? -1 : 1;
    TrackPoint<4> sum;
    for (std::size_t c = 0; c < 4; ++c) {
        sum.value[c] = a.value[c] + sign * b.value[c];
        sum.rate[c] = a.rate[c] + sign * b.rate[c];
    }
    return turning_of(sum);
}

HeadPose checked_pose(const HeadPose& pose) {
    return {checked(pose.position), checked(pose.rotation), checked(pose.chest)};
}

} // namespace

struct DrivenBust::Data {
    BustJoints joints;
    Stretch stretch;
    LedPoint point; // the head's joint
    LedTurn head, chest;
};

DrivenBust::DrivenBust(const BustJoints& joints) : DrivenBust({joints.head, {}, {}}, joints) {}

DrivenBust::DrivenBust(const HeadPose& begin, const BustJoints& joints) {
    const HeadPose pose = checked_pose(begin);
    data_ = std::make_unique<Data>(Data{joints,
                                        {},
                                        LedPoint::at_rest(pose.position),
                                        LedTurn::at_rest(pose.rotation),
                                        LedTurn::at_rest(pose.chest)});
}
DrivenBust::~DrivenBust() = default;

void DrivenBust::move_to(const HeadPose& to_pose, double from, double to) {
    const HeadPose pose = checked_pose(to_pose);
    const Stretch next = stretch(from, to), now = data_->stretch;
    data_->point = data_->point.led(pose.position, from, now);
    data_->head = data_->head.led(pose.rotation, from, now);
    data_->chest = data_->chest.led(pose.chest, from, now);
    data_->stretch = next;
}

void DrivenBust::jump(const Pose& by) {
    const Pose pose = checked(by);
    data_->point.jump(pose);
    data_->head.jump(pose);
    data_->chest.jump(pose);
}

HeadPose DrivenBust::target() const {
    return {data_->point.end, data_->head.end, data_->chest.end};
}

void DrivenBust::evaluate(double time, std::span<BonePose> bones) const {
    const Stretch& now = data_->stretch;
    const Turning chest = data_->chest.at(time, now), head = data_->head.at(time, now);
    pose_from_head(data_->joints, data_->point.at(time, now), {chest, halfway(chest, head), head},
                   bones);
}

HeadPose head_pose(const Motion& bust, double time, const BustJoints& joints) {
    std::vector<BonePose> bones(bust.bone_count());
    bust.evaluate(time, bones);
    const BonePose& head = bones[kHeadBone];
    return {head.rotation.rotate(joints.head) + head.position, head.rotation,
            bones[kChestBone].rotation};
}

} // namespace mane
