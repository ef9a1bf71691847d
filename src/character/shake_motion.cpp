#include "base/functions.h"
#include "character/bust_chain.h"
#include "character/head_turn.h"
#include "mane/error.h"

#include <cmath>
#include <string>

namespace mane {
namespace {

class ShakeMotion final : public Motion {
  public:
    ShakeMotion(double angle, double rate, const BustJoints& joints)
        : angle_(angle), pulse_(2 * kPi * rate), joints_(joints) {}

    std::size_t bone_count() const override { return kBustBones; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        const double phase = pulse_ * time;
        const HeadTurnMotion head{{.yaw = angle_ * sine(phase)},
                                  {.yaw = angle_ * pulse_ * cosine(phase)}};
        pose_from_chest(joints_, {joints_.chest, {}}, bust_turning({}, head), bones);
    }

  private:
    double angle_, pulse_; // [rad], [rad/s]
    BustJoints joints_;
};

} // namespace

std::shared_ptr<const Motion> shake_motion(double angle, double rate, const BustJoints& joints) {
    if (!std::isfinite(angle) || !std::isfinite(rate) || !(rate > 0))
        throw InputError("a shake of " + std::to_string(angle) + " rad at " + std::to_string(rate) +
                         " Hz, expected an angle and more than 0 Hz");
    return std::make_shared<ShakeMotion>(angle, rate, joints);
}

} // namespace mane
