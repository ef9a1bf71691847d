#include "character/head_turn.h"

namespace mane {
namespace {

HeadTurn half(const HeadTurn& turn) {
    return {turn.yaw / 2, turn.pitch / 2, turn.roll / 2};
}

} // namespace

Turning turning_of(const HeadTurnMotion& turn) {
    const auto& [angle, rate] = turn;
    const Turning yaw{turn_about_y(angle.yaw), {0, rate.yaw, 0}};
    const Turning pitch{turn_about_x(angle.pitch), {rate.pitch, 0, 0}};
    const Turning roll{turn_about_z(angle.roll), {0, 0, rate.roll}};
    return turning_inside(yaw, turning_inside(pitch, roll));
}

std::array<Turning, kBustBones> bust_turning(const HeadTurnMotion& body,
                                             const HeadTurnMotion& head) {
    const Turning chest = turning_of(body);
    return {chest,
            turning_inside(chest, turning_of(HeadTurnMotion{half(head.angle), half(head.rate)})),
            turning_inside(chest, turning_of(head))};
}

} // namespace mane
