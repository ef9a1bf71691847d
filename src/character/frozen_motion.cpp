#include "character/ease.h"
#include "mane/character.h"
#include "mane/error.h"

#include <cmath>

namespace mane {
namespace {

// The motion seen through a clock that stops. The clock's rate is C², so the motion stays so.
class FrozenMotion final : public Motion {
  public:
    FrozenMotion(std::shared_ptr<const Motion> motion, double time, double duration)
        : motion_(std::move(motion)), time_(time), duration_(duration) {}

    std::size_t bone_count() const override { return motion_->bone_count(); }
    void evaluate(double time, std::span<BonePose> bones) const override {
        const Slope clock = clock_at(time);
        motion_->evaluate(clock.value, bones);
        for (BonePose& bone : bones) {
            bone.velocity *= clock.rate;
            bone.angular_velocity *= clock.rate;
        }
    }

  private:
    Slope clock_at(double time) const {
        const double s = (time - time_) / duration_;
        if (s <= 0)
            return {time, 1};
        if (s >= 1)
            return {time_ + duration_ / 2, 0};
        return {time_ + duration_ * (s - ease_integral(s)), 1 - ease(s).value};
    }

    std::shared_ptr<const Motion> motion_;
    double time_, duration_;
};

} // namespace

std::shared_ptr<const Motion> frozen_motion(std::shared_ptr<const Motion> motion, double time,
                                            double duration) {
    if (!(duration > 0) || !std::isfinite(duration) || !std::isfinite(time))
        throw InputError("motion frozen at " + std::to_string(time) + " s over " +
                         std::to_string(duration) + " s, expected a time and more than 0 s");
    return std::make_shared<FrozenMotion>(std::move(motion), time, duration);
}

} // namespace mane
