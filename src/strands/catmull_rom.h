#pragma once

namespace mane {

/// The shares of four neighbouring control points in a Catmull-Rom curve, at `t` from the second
/// (0) to the third (1).
struct CatmullRomWeights {
    float of[4];

    explicit CatmullRomWeights(float t) {
        const float squared = t * t, cubed = squared * t;
        of[0] = squared - 0.5f * (t + cubed);
        of[1] = 1 + (1.5f * cubed - 2.5f * squared);
        of[2] = 0.5f * t + (2 * squared - 1.5f * cubed);
        of[3] = 0.5f * (cubed - squared);
    }
    /// The curve through `points[0]` … `points[3]`.
    float at(const float* points) const {
        return points[0] * of[0] + points[1] * of[1] + points[2] * of[2] + points[3] * of[3];
    }
};

/// How far a Catmull-Rom curve through values that spread over `spread` passes beyond the largest:
/// the two outer of its four weights are at least −1/16 each, in the middle.
constexpr float catmull_rom_overshoot(float spread) {
    return spread / 8;
}

} // namespace mane
