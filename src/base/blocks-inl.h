// Fours (base/four.h) side by side in one vector: what is met in no order is fetched four numbers
// at a time and reckoned with as many at once as the instruction set has room for. Included like
// base/pack-inl.h.
#if defined(MANE_BASE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_BASE_BLOCKS_INL_H
#undef MANE_BASE_BLOCKS_INL_H
#else
#define MANE_BASE_BLOCKS_INL_H
#endif

#include "base/four.h"
#include "base/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

struct Blocks {
    static constexpr std::size_t kCount = 1;
    Four v;

    static HWY_INLINE Blocks zero() { return {Four{}}; }
    static HWY_INLINE Blocks load(const Four* p) { return {*p}; }
    static HWY_INLINE Blocks same(const Four& x) { return {x}; }
    static HWY_INLINE Blocks pick(const Four* base, const std::uint32_t* at) {
        return {base[at[0]]};
    }
    static HWY_INLINE Blocks every(const Four* p, std::size_t) { return {*p}; }
    template <int kPlace> HWY_INLINE Blocks all() const { return {four(v[kPlace])}; }
    template <int kPlaces> HWY_INLINE Blocks turned() const {
        return {Four{v[kPlaces], v[(kPlaces + 1) % 3], v[(kPlaces + 2) % 3], v[3]}};
    }
    HWY_INLINE void store(Four* p) const { *p = v; }
};
HWY_INLINE Blocks operator+(Blocks a, Blocks b) {
    return {a.v + b.v};
}
HWY_INLINE Blocks operator-(Blocks a, Blocks b) {
    return {a.v - b.v};
}
HWY_INLINE Blocks operator*(Blocks a, Blocks b) {
    return {a.v * b.v};
}

#else

template <typename D> HWY_INLINE hn::Vec<D> fetch(D d, const Four* base, const std::uint32_t* at) {
    if constexpr (hn::MaxLanes(d) == 4) {
        return hn::Load(d, reinterpret_cast<const float*>(base + *at));
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, fetch(half, base, at + hn::MaxLanes(half) / 4),
                           fetch(half, base, at));
    }
}

/// In every block, the first three in a ring. (Highway's look-up of lanes goes through memory in
/// WebAssembly; the vectors that it emulates, where Clang has none, are arrays.)
template <int a, std::size_t kBlocks, typename V> HWY_INLINE V turned_blocks(V v) {
    constexpr int b = (a + 1) % 3, c = (a + 2) % 3;
#if HWY_TARGET == HWY_EMU128
    alignas(16) static constexpr std::int32_t kFrom[4] = {a, b, c, 3};
    return hn::TableLookupLanes(v, hn::SetTableIndices(Tag(), kFrom));
#else
    if constexpr (kBlocks == 1)
        return V{__builtin_shufflevector(v.raw, v.raw, a, b, c, 3)};
    else if constexpr (kBlocks == 2)
        return V{__builtin_shufflevector(v.raw, v.raw, a, b, c, 3, a + 4, b + 4, c + 4, 7)};
    else
        return V{__builtin_shufflevector(v.raw, v.raw, a, b, c, 3, a + 4, b + 4, c + 4, 7, //
                                         a + 8, b + 8, c + 8, 11, a + 12, b + 12, c + 12, 15)};
#endif
}

struct Blocks {
    static constexpr std::size_t kCount = kPackLanes / 4;
    hn::Vec<Tag> v;

    static HWY_INLINE Blocks zero() { return {hn::Zero(Tag())}; }
    static HWY_INLINE Blocks load(const Four* p) {
        return {hn::Load(Tag(), reinterpret_cast<const float*>(p))};
    }
    /// The same Four everywhere.
    static HWY_INLINE Blocks same(const Four& x) {
        return {hn::LoadDup128(Tag(), reinterpret_cast<const float*>(&x))};
    }
    /// Fours that are `stride` apart.
    static HWY_INLINE Blocks every(const Four* p, std::size_t stride) {
        if (stride == 1)
            return load(p);
        std::uint32_t at[kCount];
        for (std::size_t b = 0; b < kCount; ++b)
            at[b] = static_cast<std::uint32_t>(b * stride);
        return pick(p, at);
    }
    /// One Four per block, from wherever it is.
    static HWY_INLINE Blocks pick(const Four* base, const std::uint32_t* at) {
        return {fetch(Tag(), base, at)};
    }
    /// In every block, one of its numbers in all places.
    template <int kPlace> HWY_INLINE Blocks all() const { return {hn::Broadcast<kPlace>(v)}; }
    /// In every block, the first three in a ring, so many places on: y, z, x or z, x, y.
    template <int kPlaces> HWY_INLINE Blocks turned() const {
        return {turned_blocks<kPlaces, kCount>(v)};
    }
    HWY_INLINE void store(Four* p) const { hn::Store(v, Tag(), reinterpret_cast<float*>(p)); }
};
HWY_INLINE Blocks operator+(Blocks a, Blocks b) {
    return {hn::Add(a.v, b.v)};
}
HWY_INLINE Blocks operator-(Blocks a, Blocks b) {
    return {hn::Sub(a.v, b.v)};
}
HWY_INLINE Blocks operator*(Blocks a, Blocks b) {
    return {hn::Mul(a.v, b.v)};
}

#endif

/// Four Fours, whatever the width of the machine's vectors.
struct FourBlocks {
    static constexpr std::size_t kParts = 4 / Blocks::kCount;
    Blocks part[kParts];

    static HWY_INLINE FourBlocks zero() {
        FourBlocks z;
        for (Blocks& p : z.part)
            p = Blocks::zero();
        return z;
    }
    HWY_INLINE Four sum() const {
        alignas(64) Four all[4];
        for (std::size_t p = 0; p < kParts; ++p)
            part[p].store(all + p * Blocks::kCount);
        return (all[0] + all[1]) + (all[2] + all[3]);
    }
};

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
