#pragma once

#include "mane/vec.h"

#include <bit>
#include <cstddef>

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
/// The sum of all four.
inline float sum_of(const Four& a) {
    const Four halves = a + __builtin_shufflevector(a, a, 2, 3, 0, 1);
    return halves[0] + halves[1];
}
/// The dot product of the first three.
inline float dot(const Four& a, const Four& b) {
    const Four m = a * b;
    return m[0] + m[1] + m[2];
}

/// Whether something holds for each of four numbers: what a comparison of two Four gives.
using FourBits [[gnu::vector_size(16)]] = int;

/// The numbers for which it holds, by rising place: for (std::size_t i : Those(a < b)).
class Those {
  public:
    explicit Those(const FourBits& bits) : set_(mask(bits)) {}

    class Iterator {
      public:
        explicit Iterator(unsigned set) : set_(set) {}
        std::size_t operator*() const { return static_cast<std::size_t>(std::countr_zero(set_)); }
        Iterator& operator++() {
            set_ &= set_ - 1;
            return *this;
        }
        bool operator==(const Iterator&) const = default;

      private:
        unsigned set_;
    };
    Iterator begin() const { return Iterator(set_); }
    Iterator end() const { return Iterator(0); }

  private:
    static unsigned mask(const FourBits& bits) {
#if defined(__SSE__)
        return static_cast<unsigned>(__builtin_ia32_movmskps(reinterpret_cast<const Four&>(bits)));
#else
        unsigned set = 0;
        for (unsigned i = 0; i < 4; ++i)
            set |= bits[i] != 0 ? 1u << i : 0u;
        return set;
#endif
    }

    unsigned set_;
};

} // namespace mane
