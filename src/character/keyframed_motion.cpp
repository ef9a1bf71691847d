#include "character/rotation.h"
#include "mane/character.h"
#include "mane/error.h"

#include <cmath>

namespace mane {
namespace {

bool finite(const MotionKey& key) {
    const auto& [time, p, q] = key;
    return std::isfinite(time) && std::isfinite(dot(p, p)) && std::isfinite(dot(q, q));
}

void check_keys(const std::vector<MotionKey>& keys) {
    if (keys.empty())
        throw InputError("keyframed motion: no keys, expected at least one");
    for (std::size_t k = 0; k < keys.size(); ++k) {
        const std::string where = "keyframed motion, key " + std::to_string(k) + ": ";
        if (!finite(keys[k]))
            throw InputError(where + "not finite");
        if (!(dot(keys[k].rotation, keys[k].rotation) > 0))
            throw InputError(where + "the rotation is the zero quaternion");
        if (k > 0 && !(keys[k].time > keys[k - 1].time))
            throw InputError(where + "time " + std::to_string(keys[k].time) + " s after " +
                             std::to_string(keys[k - 1].time) + " s, expected rising times");
    }
}

class KeyframedMotion final : public Motion {
  public:
    KeyframedMotion(std::vector<double> times, const std::vector<std::array<double, 3>>& positions,
                    const std::vector<std::array<double, 4>>& rotations)
        : position_(times, positions, TrackEnd::rest),
          rotation_(std::move(times), rotations, TrackEnd::rest) {}

    std::size_t bone_count() const override { return 1; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        const auto [p, v] = position_.evaluate(time);
        const Turning turning = turning_of(rotation_.evaluate(time));
        bones[0] = {
            {p[0], p[1], p[2]}, turning.rotation, {v[0], v[1], v[2]}, turning.angular_velocity};
    }

  private:
    Track<3> position_;
    Track<4> rotation_;
};

} // namespace

std::shared_ptr<const Motion> keyframed_motion(const std::vector<MotionKey>& keys) {
    check_keys(keys);
    std::vector<double> times;
    std::vector<std::array<double, 3>> positions;
    std::vector<std::array<double, 4>> rotations;
    for (const MotionKey& key : keys) {
        const Quatd q = normalized(key.rotation);
        times.push_back(key.time);
        positions.push_back({key.position.x, key.position.y, key.position.z});
        rotations.push_back({q.x, q.y, q.z, q.w});
    }
    align_signs(rotations);
    return std::make_shared<KeyframedMotion>(std::move(times), positions, rotations);
}

} // namespace mane
