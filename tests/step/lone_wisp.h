#pragma once

/// One straight wisp on a peg, far enough below it to touch nothing: a World without contacts.

#include "mane/style.h"
#include "mane/world.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

namespace mane {

/// A body that stands turned by 90° about z: what was designed straight down stands out along x.
class TurnedSideways final : public Motion {
  public:
    std::size_t bone_count() const override { return 1; }
    void evaluate(double, std::span<BonePose> bones) const override {
        constexpr double kHalf = 0.70710678118654752;
        bones[0] = {};
        bones[0].rotation = {0, 0, kHalf, kHalf};
    }
};

/// A body that moves 5 mm along x in the first 0.3 s and then stands still.
class Nudge final : public Motion {
  public:
    static constexpr double kSeconds = 0.3;
    std::size_t bone_count() const override { return 1; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        constexpr double kWay = 0.005, kRate = std::numbers::pi / kSeconds;
        const double t = std::clamp(time, 0.0, kSeconds);
        bones[0] = {};
        bones[0].position = {kWay / 2 * (1 - std::cos(kRate * t)), 0, 0};
        bones[0].velocity = {kWay / 2 * kRate * std::sin(kRate * t), 0, 0};
    }
};

struct LoneWisp {
    StraightWisp shape;
    SimulationDesc desc;
    std::shared_ptr<const Motion> motion = std::make_shared<Nudge>();

    LoneWisp() {
        shape.depth = 0.06f;
        desc.wisps.mode = WispContactMode::off;
        desc.schedule.frame_rate = 240;
    }
    Groom groom() const {
        const Mesh peg = make_peg(0.02f).mesh;
        const WispDesign wisp = design(shape, peg);
        return make_groom(std::span(&wisp, 1), peg);
    }
    World world() const {
        Body peg = make_peg(0.02f);
        peg.motion = motion;
        return World(desc, groom(), {peg});
    }
};

/// The tip as seen from x₁ [m].
inline Vec3d tip_of(const World& world) {
    const std::vector<Vec3>& x = world.frame().position;
    return Vec3d(x.back()) - Vec3d(x[1]);
}

} // namespace mane
