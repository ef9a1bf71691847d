#pragma once

#include <array>
#include <cstddef>

namespace mane {

/// One piece of a Catmull-Rom curve in powers of t, 0 ≤ t ≤ 1: exact at its first control point.
/// `V` is a number or a vector.
template <typename V> struct CatmullRom {
    V c0{}, c1{}, c2{}, c3{};

    CatmullRom() = default;
    /// The piece from `b` to `c`; `a` and `d` are their neighbours.
    CatmullRom(const V& a, const V& b, const V& c, const V& d)
        : c0(b), c1((c - a) * 0.5f), c2(a - b * 2.5f + c * 2.0f - d * 0.5f),
          c3((b - c) * 1.5f + (d - a) * 0.5f) {}

    V at(float t) const { return c0 + (c1 + (c2 + c3 * t) * t) * t; }
};

/// Piece `i` of the curve through `points(0) … points(last)`, with the end points duplicated
/// (§5.2).
template <typename Points>
auto catmull_rom_piece(const Points& points, std::size_t i, std::size_t last) {
    const std::size_t before = i == 0 ? 0 : i - 1, after = i + 2 > last ? last : i + 2;
    return CatmullRom(points(before), points(i), points(i + 1), points(after));
}

/// How far a Catmull-Rom curve through values that spread over `spread` passes beyond the largest:
/// the two outer of its four weights are at least −1/16 each, in the middle.
constexpr float catmull_rom_overshoot(float spread) {
    return spread / 8;
}

} // namespace mane
