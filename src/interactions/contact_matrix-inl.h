// (W + Z)⁻¹ of contacts between wisps, a few at a time (§4.1; docs/model.md, "Each contact is one
// impulse"). In double: viscosity and the light envelope points make inverse masses that differ by
// a factor of ten thousand between directions, and the weak direction's digits must survive the
// strong one's.
#if defined(MANE_INTERACTIONS_CONTACT_MATRIX_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_INTERACTIONS_CONTACT_MATRIX_INL_H
#undef MANE_INTERACTIONS_CONTACT_MATRIX_INL_H
#else
#define MANE_INTERACTIONS_CONTACT_MATRIX_INL_H
#endif

#include "base/functions.h"
#include "base/pack-inl.h"
#include "interactions/wisp_answers.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// Doubles side by side, as many as `D` says.
template <typename D> struct Reals {
    hn::Vec<D> v;

    Reals() = default;
    HWY_INLINE Reals(hn::Vec<D> vector) : v(vector) {}
    HWY_INLINE Reals(double x) : v(hn::Set(D(), x)) {}
    friend HWY_INLINE Reals operator+(Reals a, Reals b) { return hn::Add(a.v, b.v); }
    friend HWY_INLINE Reals operator-(Reals a, Reals b) { return hn::Sub(a.v, b.v); }
    friend HWY_INLINE Reals operator*(Reals a, Reals b) { return hn::Mul(a.v, b.v); }
    friend HWY_INLINE Reals operator/(Reals a, Reals b) { return hn::Div(a.v, b.v); }
    HWY_INLINE Reals operator-() const { return hn::Neg(v); }
};
template <typename D> HWY_INLINE Reals<D> where_over(Reals<D> x, double limit, Reals<D> value) {
    return hn::IfThenElseZero(hn::Gt(x.v, hn::Set(D(), limit)), value.v);
}
template <typename D> HWY_INLINE Reals<D> clamped_to_one(Reals<D> x) {
    const auto zero = hn::Zero(D()), one = hn::Set(D(), 1.0);
    const auto low = hn::IfThenElse(hn::Lt(x.v, zero), zero, x.v);
    return hn::IfThenElse(hn::Gt(low, one), one, low);
}
template <typename D> struct Reals3 { Reals<D> x, y, z; };
template <typename D> HWY_INLINE Reals<D> dot(const Reals3<D>& a, const Reals3<D>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename D> HWY_INLINE Reals3<D> cross(const Reals3<D>& a, const Reals3<D>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Symmetric 3×3 matrices.
template <typename T> struct SymmetricOf { T xx, yy, zz, xy, xz, yz; };
template <typename D> using Symmetrics = SymmetricOf<Reals<D>>;

template <typename T, typename V>
HWY_INLINE void add_outer(SymmetricOf<T>& m, const V& a, const T& s) {
    const T x = s * a.x, y = s * a.y, z = s * a.z;
    m.xx = m.xx + x * a.x, m.yy = m.yy + y * a.y, m.zz = m.zz + z * a.z;
    m.xy = m.xy + x * a.y, m.xz = m.xz + x * a.z, m.yz = m.yz + y * a.z;
}
template <typename T> HWY_INLINE void add_identity(SymmetricOf<T>& m, const T& s) {
    m.xx = m.xx + s, m.yy = m.yy + s, m.zz = m.zz + s;
}
template <typename D>
HWY_INLINE void add(Symmetrics<D>& m, const SymmetricOf<double>& a, Reals<D> s) {
    m.xx = m.xx + s * Reals<D>(a.xx), m.yy = m.yy + s * Reals<D>(a.yy);
    m.zz = m.zz + s * Reals<D>(a.zz), m.xy = m.xy + s * Reals<D>(a.xy);
    m.xz = m.xz + s * Reals<D>(a.xz), m.yz = m.yz + s * Reals<D>(a.yz);
}
/// By cofactors, times `scale`; 0 where nothing could move.
template <typename D>
HWY_INLINE Symmetrics<D> inverse(const Symmetrics<D>& m, Reals<D> trace, Reals<D> scale) {
    using R = Reals<D>;
    const R bc = m.yy * m.zz - m.yz * m.yz, ef = m.xz * m.yz - m.xy * m.zz,
            df = m.xy * m.yz - m.xz * m.yy;
    const R determinant = m.xx * bc + m.xy * ef + m.xz * df;
    const auto moves = hn::Gt(trace.v, hn::Zero(D()));
    const R by = hn::IfThenElseZero(
        moves, (scale / R(hn::IfThenElse(moves, determinant.v, hn::Set(D(), 1.0)))).v);
    return {bc * by, (m.xx * m.zz - m.xz * m.xz) * by, (m.xx * m.yy - m.xy * m.xy) * by, ef * by,
            df * by, (m.xy * m.xz - m.xx * m.yz) * by};
}

/// 3τ² − 2τ³, from 0 at `low` to 1 at `high`.
template <typename D> HWY_INLINE Reals<D> smooth_step(Reals<D> x, double low, double high) {
    const Reals<D> t = clamped_to_one((x - low) / Reals<D>(high - low));
    return t * t * (Reals<D>(3.0) - Reals<D>(2.0) * t);
}

/// (1 − f)/f with f = 1 − e^−y the share of a velocity that drag takes, at least a millionth (no
/// friction at all would be an infinite viscosity); 0 where y is 0, which stands for a collision.
template <typename D> HWY_INLINE Reals<D> viscosity_of_drag(Reals<D> y) {
    using R = Reals<D>;
    R share;
    if (hn::AllFalse(D(), hn::Gt(y.v, hn::Set(D(), 0.125)))) {
        // Taylor's series, its first term left out under 1e-12 of the sum
        R p(-1.0 / 40320);
        for (double c : {1.0 / 5040, -1.0 / 720, 1.0 / 120, -1.0 / 24, 1.0 / 6, -0.5, 1.0})
            p = p * y + R(c);
        share = p * y;
    } else {
        HWY_ALIGN double each[hn::MaxLanes(D())];
        hn::Store(y.v, D(), each);
        for (double& x : each)
            x = 1 - exponential(-x);
        share = hn::Load(D(), each);
    }
    const auto least = hn::Set(D(), 1e-6);
    share = hn::IfThenElse(hn::Lt(share.v, least), least, share.v);
    return hn::IfThenElseZero(hn::Gt(y.v, hn::Zero(D())), ((R(1.0) - share) / share).v);
}

/// Adds Z of wisps with the directions σ_p and σ_s (M24, M25): weak in their plane, rigid across it
/// as far as there is a plane. `drag` as above, times the mean of W.
template <typename D> HWY_INLINE void add_viscosity(Symmetrics<D>& w, const Reals3<D>& point,
                                                    const Reals3<D>& segment, Reals<D> mean,
                                                    Reals<D> drag, const WispAnswers& a) {
    using R = Reals<D>;
    const Reals3<D> n = cross(point, segment);
    const R square = dot(n, n), sine = hn::Sqrt(square.v);
    // Sliding ends smoothly at the parallel angle, where the pair becomes a collision: a wisp that
    // leans on another would else be dropped where the other's next segment turns.
    const R slides = clamped_to_one((R(a.sine_none) - sine) / R(a.sine_none - a.sine_full));
    const R in = mean * slides * slides * drag;
    const R fade = smooth_step(sine, 0.5 * a.sine_fade, a.sine_fade);
    const R out = mean * drag * (R(1.0) - fade) / (R(1.0) + drag * fade);
    add_identity(w, in);
    const auto plane = hn::Gt(fade.v, hn::Zero(D()));
    const R across = hn::IfThenElseZero(
        plane, ((out - in) / R(hn::IfThenElse(plane, square.v, hn::Set(D(), 1.0)))).v);
    add_outer(w, n, across);
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
