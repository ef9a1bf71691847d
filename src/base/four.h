#pragma once

#include "mane/vec.h"

namespace mane {

/// Four numbers that are reckoned with together, in one vector register: for the few places that
/// look at four things of a kind at a time, and for vectors that are met in no order (three numbers
/// and one to spare). GCC does not find either by itself. (What runs over many wisps is written
/// with base/pack-inl.h.)
using Four [[gnu::vector_size(16)]] = float;

inline Four larger(const Four& a, const Four& b) {
    return a > b ? a : b;
}
inline Four smaller(const Four& a, const Four& b) {
    return a < b ? a : b;
}

inline Four four(const Vec3& v, float last = 0) {
    return Four{v.x, v.y, v.z, last};
}
inline Four four(float x) {
    return Four{x, x, x, x};
}
inline Vec3 first_three(const Four& a) {
    return {a[0], a[1], a[2]};
}
/// The dot product of the first three.
inline float dot(const Four& a, const Four& b) {
    const Four m = a * b;
    return m[0] + m[1] + m[2];
}

} // namespace mane
