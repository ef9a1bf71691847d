#include "base/functions.h"
#include "character/bust_chain.h"
#include "character/ease.h"
#include "character/head_turn.h"

namespace mane {
namespace {

// What a piece of the choreography moves.
enum Part {
    head_yaw,
    head_pitch,
    head_roll, // [deg] on the shoulders
    body_yaw,
    body_pitch,
    body_roll, // [deg] at the waist
    body_x,
    body_y,
    body_z, // [m]
    part_count,
};

// A move from `start` to `end` [s] by `amount`. Without waves it is a turn that stays; with waves
// it swings that often and fades in and out.
struct Move {
    Part part;
    double start, end;
    double amount;
    double waves = 0;
};

// Peaks, chosen among those of the captured clips: head 2 m/s, 10 rad/s.
constexpr Move kChoreography[] = {
    // breathing and shifting weight, all the time
    {body_pitch, 0.0, 11.0, 1.5, 4.0},
    {body_roll, 0.0, 11.0, 2.0, 3.5},
    {body_x, 0.0, 11.0, 0.015, 3.5},
    // looks to the left, then to the right, and back
    {head_yaw, 0.2, 0.9, 40},
    {head_roll, 0.2, 0.9, -6},
    {head_yaw, 1.1, 1.9, -75},
    {head_roll, 1.1, 1.9, 12},
    {head_yaw, 2.0, 2.5, 35},
    {head_roll, 2.0, 2.5, -6},
    // "no": a long shake of the head, the shoulders against it
    {head_yaw, 2.4, 4.4, 48, 4},
    {body_yaw, 2.4, 4.4, -6, 4},
    // "yes": nods
    {head_pitch, 4.3, 5.8, 22, 3},
    {body_pitch, 4.3, 5.8, 3, 3},
    // bows, and throws the hair back
    {body_pitch, 5.7, 6.3, 38},
    {head_pitch, 5.7, 6.3, 26},
    {body_pitch, 6.3, 6.9, -38},
    {head_pitch, 6.3, 6.8, -46},
    {head_pitch, 6.9, 7.4, 20},
    // winds up, whirls once around and a bit more with a hop to the side, and comes back
    {body_yaw, 6.8, 7.3, -35},
    {body_yaw, 7.2, 8.8, 425},
    {head_yaw, 7.1, 7.6, -15},
    {head_yaw, 7.6, 8.4, 35},
    {head_yaw, 8.4, 9.0, -20},
    {body_x, 7.3, 8.1, 0.30},
    {body_z, 7.6, 8.5, 0.20},
    {body_y, 7.3, 8.7, 0.05, 1},
    {body_yaw, 8.8, 9.5, -30},
    // sways, stepping back to where it began
    {body_x, 9.0, 10.0, -0.30},
    {body_z, 9.1, 10.1, -0.20},
    {body_roll, 9.0, 10.6, 14, 2},
    {head_roll, 9.1, 10.7, 16, 2},
    // a last short shake
    {head_yaw, 10.0, 11.0, 32, 2},
    {head_pitch, 10.2, 11.0, 8, 1},
};

Slope move_at(const Move& move, double time) {
    const double span = move.end - move.start, s = (time - move.start) / span;
    if (move.waves == 0) {
        const Slope turn = ease(s);
        return {move.amount * turn.value, move.amount * turn.rate / span};
    }
    const Slope window = bump(s);
    const double phase = 2 * kPi * move.waves, x = phase * s;
    return {move.amount * window.value * sine(x),
            move.amount * (window.rate * sine(x) + window.value * phase * cosine(x)) / span};
}

struct Choreography {
    Slope parts[part_count];

    explicit Choreography(double time) {
        for (const Move& move : kChoreography) {
            const Slope moved = move_at(move, time);
            parts[move.part].value += moved.value;
            parts[move.part].rate += moved.rate;
        }
    }
    HeadTurnMotion turn(Part yaw, Part pitch, Part roll) const {
        const double degree = kPi / 180;
        return {
            {parts[yaw].value * degree, parts[pitch].value * degree, parts[roll].value * degree},
            {parts[yaw].rate * degree, parts[pitch].rate * degree, parts[roll].rate * degree}};
    }
    Vec3d shift() const { return {parts[body_x].value, parts[body_y].value, parts[body_z].value}; }
    Vec3d shift_rate() const {
        return {parts[body_x].rate, parts[body_y].rate, parts[body_z].rate};
    }
};

class BuiltinMotion final : public Motion {
  public:
    explicit BuiltinMotion(const BustJoints& joints) : joints_(joints) {}

    std::size_t bone_count() const override { return kBustBones; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        const Choreography now(time);
        const BustTurning turning = bust_turning(now.turn(body_yaw, body_pitch, body_roll),
                                                 now.turn(head_yaw, head_pitch, head_roll));
        // the body turns at the waist, so that a bow carries the head along
        const Vec3d spine = turning[kChestBone].rotation.rotate(joints_.chest - waist());
        const Vec3d turned = cross(turning[kChestBone].angular_velocity, spine);
        const PointMotion chest{waist() + spine + now.shift(), turned + now.shift_rate()};
        pose_from_chest(joints_, chest, turning, bones);
    }

  private:
    Vec3d waist() const { return joints_.chest - Vec3d(0, 0.35, 0); }

    BustJoints joints_;
};

} // namespace

std::shared_ptr<const Motion> builtin_motion(const BustJoints& joints) {
    return std::make_shared<BuiltinMotion>(joints);
}

} // namespace mane
