#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace mane {

/// Spreads every bit of `x` over the result (the finaliser of SplitMix64).
constexpr std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// A running hash over the bits of numbers, in order; the same on every machine.
class StateHash {
  public:
    void add(std::uint64_t word) { value_ = mix(value_ ^ word); }
    void add(float x) { add(std::uint64_t{std::bit_cast<std::uint32_t>(x)}); }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(std::span<const float> xs) {
        for (float x : xs)
            add(x);
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0x6d616e65; // "mane"
};

} // namespace mane
