#pragma once

#include "base/hash.h"

#include <cstdint>

namespace mane {

/// Counter-based random numbers: the n-th number of (seed, wisp, strand) depends on these four
/// alone (M15), so any strand of any frame can be made alone, in parallel, identically.
class Random {
  public:
    constexpr Random(std::uint64_t seed, std::uint64_t wisp, std::uint64_t strand = 0)
        : key_(mix(mix(mix(seed) ^ wisp) ^ strand)) {}

    /// The n-th number, uniform over all 64-bit values.
    constexpr std::uint64_t bits(std::uint64_t n) const {
        return mix(key_ ^ (n * 0xd1342543de82ef95u));
    }

    /// The n-th number, uniform in [0, 1), with 24 bits.
    constexpr float unit(std::uint64_t n) const {
        return static_cast<float>(bits(n) >> 40) * 0x1p-24f;
    }
    /// The n-th number, uniform in [low, high).
    constexpr float between(std::uint64_t n, float low, float high) const {
        return low + (high - low) * unit(n);
    }

  private:
    std::uint64_t key_;
};

} // namespace mane
