#pragma once

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

/// The bits of a number. Not std::bit_cast: Emscripten's C++ library has none yet.
inline std::uint32_t bits_of(float x) {
    return __builtin_bit_cast(std::uint32_t, x);
}
inline std::uint64_t bits_of(double x) {
    return __builtin_bit_cast(std::uint64_t, x);
}

/// A running hash over the bits of numbers, in order; the same on every machine.
class StateHash {
  public:
    void add(std::uint64_t word) { value_ = mix(value_ ^ word); }
    void add(float x) { add(std::uint64_t{bits_of(x)}); }
    void add(double x) { add(bits_of(x)); }
    void add(std::span<const float> xs) {
        for (float x : xs)
            add(x);
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0x6d616e65; // "mane"
};

} // namespace mane
