#include "lead.h"

#include "base/functions.h"
#include "character/rotation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mane::page {
namespace {

constexpr double kReach = 0.12;   ///< [s] in which the head comes where the hand wants it
constexpr double kTurnOver = 1;   ///< [s] from one motion to another
constexpr double kNeck = kPi / 3; ///< [rad] what a neck can turn; the shoulders do the rest

/// One step of a critically damped spring toward `wanted`; a rational stand-in for the exponential,
/// stable for any `seconds`.
void approach(double wanted, double seconds, double& value, double& velocity) {
    const double omega = 2 / kReach, x = omega * seconds;
    const double decay = 1 / (1 + x + 0.48 * x * x + 0.235 * x * x * x);
    const double gap = value - wanted, way = (velocity + omega * gap) * seconds;
    velocity = (velocity - omega * way) * decay;
    value = wanted + (gap + way) * decay;
}

/// 0 to 1, at rest at both ends.
double ease(double x) {
    x = std::clamp(x, 0.0, 1.0);
    return x * x * x * (x * (6 * x - 15) + 10);
}

Quatd between(const Quatd& a, const Quatd& b, double share) {
    const double other = dot(a, b) < 0 ? -share : share, own = 1 - share;
    return normalized(Quatd{own * a.x + other * b.x, own * a.y + other * b.y,
                            own * a.z + other * b.z, own * a.w + other * b.w});
}

HeadPose between(const HeadPose& a, const HeadPose& b, double share) {
    return {a.position + (b.position - a.position) * share, between(a.rotation, b.rotation, share),
            between(a.chest, b.chest, share)};
}

HeadPose held(const HeadPose& pose, const std::array<double, 6>& hold) {
    const auto& [x, y, z, yaw, pitch, roll] = hold;
    const double beyond = std::max(std::abs(yaw) - kNeck, std::abs(yaw) / 4);
    return {pose.position + Vec3d(x, y, z),
            turn_about_y(yaw) * pose.rotation * turn_about_x(pitch) * turn_about_z(roll),
            turn_about_y(yaw < 0 ? -beyond : beyond) * pose.chest};
}

} // namespace

/// The scene's own motion, or a bust that is led.
class Lead::Switch final : public Motion {
  public:
    std::size_t bone_count() const override { return kBustBones; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        if (led)
            led->evaluate(time, bones);
        else if (own)
            own->evaluate(time, bones);
        else
            std::fill(bones.begin(), bones.end(), BonePose{});
    }
    std::shared_ptr<const Motion> own;
    std::unique_ptr<DrivenBust> led; ///< null: nobody has asked for anything
};

HeadPose Lead::Path::at(double time) const {
    if (!motion)
        return {bust_joints().head + shift, {}, {}};
    double t = time - begin;
    if (length > 0 && t > length)
        t -= length * std::floor(t / length);
    HeadPose pose = head_pose(*motion, t);
    pose.position += shift;
    return pose;
}

Lead::Lead(std::shared_ptr<const Motion> motion, double length)
    : switch_(std::make_shared<Switch>()) {
    begin(std::move(motion), length);
}

void Lead::begin(std::shared_ptr<const Motion> motion, double length) {
    switch_->led = nullptr;
    switch_->own = motion;
    path_ = before_ = {std::move(motion), length, 0, {}};
    changed_ = -std::numeric_limits<double>::infinity();
    wanted_ = {};
    held_ = velocities_ = {};
}

std::shared_ptr<const Motion> Lead::motion() const {
    return switch_;
}

void Lead::hold(const Hold& hold) {
    wanted_ = hold;
}

void Lead::follow(std::shared_ptr<const Motion> motion, double length, double time) {
    take_over(time);
    const Vec3d here = pose(time).position;
    before_ = path_;
    path_ = {std::move(motion), length, time, {}};
    path_.shift = here - Vec3d(held_[0], held_[1], held_[2]) - path_.at(time).position;
    changed_ = time;
}

void Lead::jump(const Vec3d& by, double time) {
    take_over(time);
    path_.shift += by;
    before_.shift += by;
    switch_->led->jump({by, {}});
}

HeadPose Lead::pose(double time) const {
    const double share = ease((time - changed_) / kTurnOver);
    const HeadPose own = path_.at(time);
    return held(share < 1 ? between(before_.at(time), own, share) : own, held_);
}

/// The bust that is led starts where the scene's own motion has it, at its speed.
void Lead::take_over(double time) {
    if (switch_->led)
        return;
    switch_->led = std::make_unique<DrivenBust>(pose(time - frame_));
    switch_->led->move_to(pose(time), time - frame_, time);
}

void Lead::advance(double from, double to) {
    frame_ = to - from;
    const Hold& h = wanted_;
    const std::array<double, 6> wanted{h.position.x, h.position.y, h.position.z,
                                       h.turn.yaw,   h.turn.pitch, h.turn.roll};
    // A motion that begins again does so by being led.
    const bool again = path_.length > 0 && from >= path_.begin + path_.length;
    if (!switch_->led && !again && wanted == held_)
        return;
    take_over(from);
    for (std::size_t i = 0; i < wanted.size(); ++i)
        approach(wanted[i], frame_, held_[i], velocities_[i]);
    switch_->led->move_to(pose(to), from, to);
}

} // namespace mane::page
