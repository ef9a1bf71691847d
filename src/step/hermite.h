#pragma once

namespace mane {

/// Weights of a cubic Hermite curve's ends and of its slopes there, at s from 0 to 1.
struct HermiteWeights {
    float value[2], slope[2];

    static HermiteWeights at(float s) {
        return {{(1 + 2 * s) * (1 - s) * (1 - s), s * s * (3 - 2 * s)},
                {s * (1 - s) * (1 - s), s * s * (s - 1)}};
    }
    /// Of its derivative by s.
    static HermiteWeights rate_at(float s) {
        return {{6 * s * s - 6 * s, 6 * s - 6 * s * s}, {3 * s * s - 4 * s + 1, 3 * s * s - 2 * s}};
    }
};

} // namespace mane
