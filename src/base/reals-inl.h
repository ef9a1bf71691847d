// Doubles side by side, at most `kMost`: for what needs more digits than base/pack-inl.h has.
// Included like that.
#if defined(MANE_BASE_REALS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_BASE_REALS_INL_H
#undef MANE_BASE_REALS_INL_H
#else
#define MANE_BASE_REALS_INL_H
#endif

#include "base/four.h"
#include "base/pack-inl.h"

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR

template <std::size_t kMost> struct RealsMask {
    bool m;
    friend HWY_INLINE RealsMask operator&(RealsMask a, RealsMask b) { return {a.m && b.m}; }
    friend HWY_INLINE RealsMask operator|(RealsMask a, RealsMask b) { return {a.m || b.m}; }
    HWY_INLINE bool none() const { return !m; }
    HWY_INLINE std::uint32_t bits() const { return m; }
};

template <std::size_t kMost> struct Reals {
    using Mask = RealsMask<kMost>;
    static constexpr std::size_t kCount = 1;
    double v;

    Reals() = default;
    HWY_INLINE Reals(double x) : v(x) {}
    static HWY_INLINE Reals load(const double* p) { return *p; }
    HWY_INLINE void store(double* p) const { *p = v; }
    static HWY_INLINE Reals load(const float* p) { return double{*p}; }
    static HWY_INLINE Reals gather(const float* base, const std::uint32_t* at, std::size_t stride) {
        return double{base[*at * stride]};
    }
    static HWY_INLINE void store_fours(Reals x, Reals y, Reals z, Reals w, Four* p) {
        *p = Four{static_cast<float>(x.v), static_cast<float>(y.v), static_cast<float>(z.v),
                  static_cast<float>(w.v)};
    }
    friend HWY_INLINE Reals operator+(Reals a, Reals b) { return a.v + b.v; }
    friend HWY_INLINE Reals operator-(Reals a, Reals b) { return a.v - b.v; }
    friend HWY_INLINE Reals operator*(Reals a, Reals b) { return a.v * b.v; }
    friend HWY_INLINE Reals operator/(Reals a, Reals b) { return a.v / b.v; }
    friend HWY_INLINE Mask operator<(Reals a, Reals b) { return {a.v < b.v}; }
    friend HWY_INLINE Mask operator>(Reals a, Reals b) { return {a.v > b.v}; }
    friend HWY_INLINE Mask operator<=(Reals a, Reals b) { return {a.v <= b.v}; }
    friend HWY_INLINE Mask operator>=(Reals a, Reals b) { return {a.v >= b.v}; }
    HWY_INLINE Reals operator-() const { return -v; }
    friend HWY_INLINE Reals square_root(Reals a) { return std::sqrt(a.v); }
    friend HWY_INLINE Reals select(Mask m, Reals a, Reals b) { return m.m ? a : b; }
};

#elif HWY_TARGET == HWY_WASM // of which Highway has no vectors of doubles

template <std::size_t kMost> struct RealsMask {
    v128_t m;
    friend HWY_INLINE RealsMask operator&(RealsMask a, RealsMask b) {
        return {wasm_v128_and(a.m, b.m)};
    }
    friend HWY_INLINE RealsMask operator|(RealsMask a, RealsMask b) {
        return {wasm_v128_or(a.m, b.m)};
    }
    HWY_INLINE bool none() const { return !wasm_v128_any_true(m); }
    HWY_INLINE std::uint32_t bits() const {
        return static_cast<std::uint32_t>(wasm_i64x2_bitmask(m)) & (kMost < 2 ? 1 : 3);
    }
};

/// Where there is to be one, both lanes hold it.
template <std::size_t kMost> struct Reals {
    using Mask = RealsMask<kMost>;
    static constexpr std::size_t kCount = kMost < 2 ? 1 : 2;
    v128_t v;

    Reals() = default;
    HWY_INLINE Reals(v128_t vector) : v(vector) {}
    HWY_INLINE Reals(double x) : v(wasm_f64x2_splat(x)) {}
    static HWY_INLINE Reals load(const double* p) {
        return kCount < 2 ? wasm_v128_load64_splat(p) : wasm_v128_load(p);
    }
    HWY_INLINE void store(double* p) const {
        kCount < 2 ? wasm_v128_store64_lane(p, v, 0) : wasm_v128_store(p, v);
    }
    static HWY_INLINE Reals load(const float* p) { return pair(p[0], p[kCount - 1]); }
    static HWY_INLINE Reals gather(const float* base, const std::uint32_t* at, std::size_t stride) {
        return pair(base[at[0] * stride], base[at[kCount - 1] * stride]);
    }
    static HWY_INLINE void store_fours(Reals x, Reals y, Reals z, Reals w, Four* p) {
        const auto rounded = [](Reals a, Reals b) {
            return wasm_i32x4_shuffle(wasm_f32x4_demote_f64x2_zero(a.v),
                                      wasm_f32x4_demote_f64x2_zero(b.v), 0, 4, 1, 5);
        };
        const v128_t xy = rounded(x, y), zw = rounded(z, w);
        wasm_v128_store(p, wasm_i64x2_shuffle(xy, zw, 0, 2));
        if (kCount > 1)
            wasm_v128_store(p + 1, wasm_i64x2_shuffle(xy, zw, 1, 3));
    }
    friend HWY_INLINE Reals operator+(Reals a, Reals b) { return wasm_f64x2_add(a.v, b.v); }
    friend HWY_INLINE Reals operator-(Reals a, Reals b) { return wasm_f64x2_sub(a.v, b.v); }
    friend HWY_INLINE Reals operator*(Reals a, Reals b) { return wasm_f64x2_mul(a.v, b.v); }
    friend HWY_INLINE Reals operator/(Reals a, Reals b) { return wasm_f64x2_div(a.v, b.v); }
    friend HWY_INLINE Mask operator<(Reals a, Reals b) { return {wasm_f64x2_lt(a.v, b.v)}; }
    friend HWY_INLINE Mask operator>(Reals a, Reals b) { return {wasm_f64x2_gt(a.v, b.v)}; }
    friend HWY_INLINE Mask operator<=(Reals a, Reals b) { return {wasm_f64x2_le(a.v, b.v)}; }
    friend HWY_INLINE Mask operator>=(Reals a, Reals b) { return {wasm_f64x2_ge(a.v, b.v)}; }
    HWY_INLINE Reals operator-() const { return wasm_f64x2_neg(v); }
    friend HWY_INLINE Reals square_root(Reals a) { return wasm_f64x2_sqrt(a.v); }
    friend HWY_INLINE Reals select(Mask m, Reals a, Reals b) {
        return wasm_v128_bitselect(a.v, b.v, m.m);
    }

  private:
    static HWY_INLINE Reals pair(float a, float b) { return wasm_f64x2_make(double{a}, double{b}); }
};

#else

template <std::size_t kMost> struct RealsMask {
    hn::Mask<hn::CappedTag<double, kMost>> m;
    friend HWY_INLINE RealsMask operator&(RealsMask a, RealsMask b) { return {hn::And(a.m, b.m)}; }
    friend HWY_INLINE RealsMask operator|(RealsMask a, RealsMask b) { return {hn::Or(a.m, b.m)}; }
    HWY_INLINE bool none() const { return hn::AllFalse(hn::CappedTag<double, kMost>(), m); }
    /// One per lane, of which there are eight at most.
    HWY_INLINE std::uint32_t bits() const {
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(hn::CappedTag<double, kMost>(), m, bytes);
        return bytes[0];
    }
};

template <std::size_t kMost> struct Reals {
    using D = hn::CappedTag<double, kMost>;
    using Single = hn::Rebind<float, D>;
    using Mask = RealsMask<kMost>;
    static constexpr std::size_t kCount = hn::MaxLanes(D());
    hn::Vec<D> v;

    Reals() = default;
    HWY_INLINE Reals(hn::Vec<D> vector) : v(vector) {}
    HWY_INLINE Reals(double x) : v(hn::Set(D(), x)) {}
    static HWY_INLINE Reals load(const double* p) { return hn::Load(D(), p); }
    HWY_INLINE void store(double* p) const { hn::Store(v, D(), p); }
    /// Of single precision, on any border.
    static HWY_INLINE Reals load(const float* p) {
        return hn::PromoteTo(D(), hn::LoadU(Single(), p));
    }
    /// base[at · stride].
    static HWY_INLINE Reals gather(const float* base, const std::uint32_t* at,
                                   std::int32_t stride) {
        const hn::Rebind<std::int32_t, D> whole;
        const auto places = hn::LoadU(whole, reinterpret_cast<const std::int32_t*>(at));
        const auto index = stride == 1 ? places : hn::Mul(places, hn::Set(whole, stride));
        return hn::PromoteTo(D(), hn::GatherIndex(Single(), base, index));
    }
    /// Rounded, four numbers of a kind side by side.
    static HWY_INLINE void store_fours(Reals x, Reals y, Reals z, Reals w, Four* p) {
        const auto rounded = [](Reals r) { return hn::DemoteTo(Single(), r.v); };
        hn::StoreInterleaved4(rounded(x), rounded(y), rounded(z), rounded(w), Single(),
                              reinterpret_cast<float*>(p));
    }
    friend HWY_INLINE Reals operator+(Reals a, Reals b) { return hn::Add(a.v, b.v); }
    friend HWY_INLINE Reals operator-(Reals a, Reals b) { return hn::Sub(a.v, b.v); }
    friend HWY_INLINE Reals operator*(Reals a, Reals b) { return hn::Mul(a.v, b.v); }
    friend HWY_INLINE Reals operator/(Reals a, Reals b) { return hn::Div(a.v, b.v); }
    friend HWY_INLINE Mask operator<(Reals a, Reals b) { return {hn::Lt(a.v, b.v)}; }
    friend HWY_INLINE Mask operator>(Reals a, Reals b) { return {hn::Gt(a.v, b.v)}; }
    friend HWY_INLINE Mask operator<=(Reals a, Reals b) { return {hn::Le(a.v, b.v)}; }
    friend HWY_INLINE Mask operator>=(Reals a, Reals b) { return {hn::Ge(a.v, b.v)}; }
    HWY_INLINE Reals operator-() const { return hn::Neg(v); }
    friend HWY_INLINE Reals square_root(Reals a) { return hn::Sqrt(a.v); }
    friend HWY_INLINE Reals select(Mask m, Reals a, Reals b) {
        return hn::IfThenElse(m.m, a.v, b.v);
    }
};

#endif

template <std::size_t kMost> struct Reals3 {
    using R = Reals<kMost>;
    R x, y, z;

    friend HWY_INLINE Reals3 operator-(Reals3 a, Reals3 b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend HWY_INLINE R dot(const Reals3& a, const Reals3& b) {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    }
    friend HWY_INLINE Reals3 cross(const Reals3& a, const Reals3& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
};

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
