#pragma once

namespace mane {

/// Four numbers that are reckoned with together, in one vector register: for the few places that
/// look at four things of a kind at a time. (GCC does not find them by itself in loops that take
/// maxima. What runs over many wisps is written with base/pack-inl.h.)
using Four [[gnu::vector_size(16)]] = float;

inline Four larger(const Four& a, const Four& b) {
    return a > b ? a : b;
}
inline Four smaller(const Four& a, const Four& b) {
    return a < b ? a : b;
}

} // namespace mane
