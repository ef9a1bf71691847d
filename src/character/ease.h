#pragma once

namespace mane {

// A number and its derivative.
struct Slope {
    double value = 0;
    double rate = 0;
};

// 0 before s = 0, 1 after s = 1, between them a quintic: C² everywhere.
constexpr Slope ease(double s) {
    if (s <= 0)
        return {0, 0};
    if (s >= 1)
        return {1, 0};
    return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 - s) * (1 - s)};
}

// The integral of `ease` from 0 to s, for s in [0, 1].
constexpr double ease_integral(double s) {
    return s * s * s * s * (2.5 + s * (s - 3));
}

// 1 at s = ½, 0 outside of (0, 1), C² everywhere.
constexpr Slope bump(double s) {
    if (s <= 0 || s >= 1)
        return {0, 0};
    const double p = 4 * s * (1 - s);
    return {p * p * p, 3 * p * p * (4 - 8 * s)};
}

} // namespace mane
