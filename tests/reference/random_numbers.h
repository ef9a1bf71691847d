#pragma once

#include "mane/vec.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace mane::reference {

/// The same numbers on every machine: the engine is fixed by the standard, the distributions are
/// our own.
class RandomNumbers {
  public:
    explicit RandomNumbers(std::uint64_t seed) : engine_(seed * 0x9e3779b97f4a7c15u + 1) {}

    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
    }
    /// For quantities that are known to an order of magnitude.
    double around(double low, double high) { return low * std::pow(high / low, between(0, 1)); }
    /// `low` … `high`, both included.
    std::uint32_t count(std::uint32_t low, std::uint32_t high) {
        return low + static_cast<std::uint32_t>(engine_() % (high - low + 1));
    }
    bool chance(double share) { return between(0, 1) < share; }
    /// In a box of half-size `size`.
    Vec3d vector(double size) {
        const double x = between(-size, size), y = between(-size, size);
        return {x, y, between(-size, size)};
    }
    /// Unit, all directions alike.
    Vec3d direction() {
        const double z = between(-1, 1), around = between(0, 2 * std::numbers::pi);
        const double across = std::sqrt(1 - z * z);
        return {across * std::cos(around), across * std::sin(around), z};
    }
    /// Unit and perpendicular to the unit vector `t`.
    Vec3d across(const Vec3d& t) {
        for (;;) {
            const Vec3d c = cross(t, direction());
            if (length(c) > 0.1)
                return normalized(c);
        }
    }

  private:
    std::mt19937_64 engine_;
};

} // namespace mane::reference
