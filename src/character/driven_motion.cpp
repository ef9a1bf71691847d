#include "character/led.h"
#include "mane/error.h"

#include <string>
#include <vector>

namespace mane {

struct DrivenMotion::Data {
    struct Way {
        Vec3d pivot;
        LedPoint point; // the pivot's
        LedTurn turn;

        Way led(const Pose& to, double time, const Stretch& now) const {
            return {pivot, point.led(to.rotation.rotate(pivot) + to.position, time, now),
                    turn.led(to.rotation, time, now)};
        }
    };
    Stretch stretch;
    std::vector<Way> ways; // per bone
};

DrivenMotion::DrivenMotion(std::span<const Bone> bones) : data_(std::make_unique<Data>()) {
    if (bones.empty())
        throw InputError("a driven motion of no bones; expected at least one");
    for (const Bone& bone : bones) {
        const Pose pose = checked(bone.begin);
        const Vec3d pivot = checked(bone.pivot);
        data_->ways.push_back({pivot,
                               LedPoint::at_rest(pose.rotation.rotate(pivot) + pose.position),
                               LedTurn::at_rest(pose.rotation)});
    }
}
DrivenMotion::~DrivenMotion() = default;

void DrivenMotion::move_to(std::span<const Pose> poses, double from, double to) {
    if (poses.size() != data_->ways.size())
        throw InputError(std::to_string(poses.size()) + " poses for a motion of " +
                         std::to_string(data_->ways.size()) + " bones");
    const Stretch next = stretch(from, to);
    std::vector<Data::Way> ways;
    for (std::size_t b = 0; b < poses.size(); ++b)
        ways.push_back(data_->ways[b].led(checked(poses[b]), from, data_->stretch));
    data_->ways = std::move(ways);
    data_->stretch = next;
}

void DrivenMotion::jump(const Pose& by) {
    const Pose pose = checked(by);
    for (Data::Way& way : data_->ways) {
        way.point.jump(pose);
        way.turn.jump(pose);
    }
}

std::size_t DrivenMotion::bone_count() const {
    return data_->ways.size();
}

void DrivenMotion::evaluate(double time, std::span<BonePose> bones) const {
    for (std::size_t b = 0; b < data_->ways.size(); ++b) {
        const Data::Way& way = data_->ways[b];
        bones[b] = bone_through(way.pivot, way.point.at(time, data_->stretch),
                                way.turn.at(time, data_->stretch));
    }
}

} // namespace mane
