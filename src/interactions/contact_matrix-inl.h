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
#include "base/reals-inl.h"
#include "interactions/wisp_answers.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

template <std::size_t N> HWY_INLINE Reals<N> clamped_to_one(Reals<N> x) {
    const Reals<N> zero(0.0), one(1.0);
    const Reals<N> low = select(x < zero, zero, x);
    return select(low > one, one, low);
}

/// Symmetric 3×3 matrices.
template <typename T> struct SymmetricOf { T xx, yy, zz, xy, xz, yz; };
template <std::size_t N> using Symmetrics = SymmetricOf<Reals<N>>;

template <typename T, typename V>
HWY_INLINE void add_outer(SymmetricOf<T>& m, const V& a, const T& s) {
    const T x = s * a.x, y = s * a.y, z = s * a.z;
    m.xx = m.xx + x * a.x, m.yy = m.yy + y * a.y, m.zz = m.zz + z * a.z;
    m.xy = m.xy + x * a.y, m.xz = m.xz + x * a.z, m.yz = m.yz + y * a.z;
}
template <typename T> HWY_INLINE void add_identity(SymmetricOf<T>& m, const T& s) {
    m.xx = m.xx + s, m.yy = m.yy + s, m.zz = m.zz + s;
}
template <std::size_t N>
HWY_INLINE void add(Symmetrics<N>& m, const SymmetricOf<double>& a, Reals<N> s) {
    using R = Reals<N>;
    m.xx = m.xx + s * R(a.xx), m.yy = m.yy + s * R(a.yy), m.zz = m.zz + s * R(a.zz);
    m.xy = m.xy + s * R(a.xy), m.xz = m.xz + s * R(a.xz), m.yz = m.yz + s * R(a.yz);
}
/// By cofactors, times `scale`; 0 where nothing could move.
template <std::size_t N>
HWY_INLINE Symmetrics<N> inverse(const Symmetrics<N>& m, Reals<N> trace, Reals<N> scale) {
    using R = Reals<N>;
    const R bc = m.yy * m.zz - m.yz * m.yz, ef = m.xz * m.yz - m.xy * m.zz,
            df = m.xy * m.yz - m.xz * m.yy;
    const R determinant = m.xx * bc + m.xy * ef + m.xz * df;
    const auto moves = trace > R(0.0);
    const R by = select(moves, scale / select(moves, determinant, R(1.0)), R(0.0));
    return {bc * by, (m.xx * m.zz - m.xz * m.xz) * by, (m.xx * m.yy - m.xy * m.xy) * by, ef * by,
            df * by, (m.xy * m.xz - m.xx * m.yz) * by};
}

/// 3τ² − 2τ³, from 0 at `low` to 1 at `high`.
template <std::size_t N> HWY_INLINE Reals<N> smooth_step(Reals<N> x, double low, double high) {
    const Reals<N> t = clamped_to_one((x - low) / Reals<N>(high - low));
    return t * t * (Reals<N>(3.0) - Reals<N>(2.0) * t);
}

/// (1 − f)/f with f = 1 − e^−y the share of a velocity that drag takes, at least a millionth (no
/// friction at all would be an infinite viscosity); 0 where y is 0, which stands for a collision.
template <std::size_t N> HWY_INLINE Reals<N> viscosity_of_drag(Reals<N> y) {
    using R = Reals<N>;
    R share;
    if ((y > R(0.125)).none()) {
        // Taylor's series, its first term left out under 1e-12 of the sum
        R p(-1.0 / 40320);
        for (double c : {1.0 / 5040, -1.0 / 720, 1.0 / 120, -1.0 / 24, 1.0 / 6, -0.5, 1.0})
            p = p * y + R(c);
        share = p * y;
    } else {
        HWY_ALIGN double each[R::kCount];
        y.store(each);
        for (double& x : each)
            x = 1 - exponential(-x);
        share = R::load(each);
    }
    share = select(share < R(1e-6), R(1e-6), share);
    return select(y > R(0.0), (R(1.0) - share) / share, R(0.0));
}

/// Adds Z of wisps with the directions σ_p and σ_s (M24, M25): weak in their plane, rigid across it
/// as far as there is a plane. `drag` as above, times the mean of W.
template <std::size_t N> HWY_INLINE void add_viscosity(Symmetrics<N>& w, const Reals3<N>& point,
                                                       const Reals3<N>& segment, Reals<N> mean,
                                                       Reals<N> drag, const WispAnswers& a) {
    using R = Reals<N>;
    const Reals3<N> n = cross(point, segment);
    const R square = dot(n, n), sine = square_root(square);
    // Sliding ends smoothly at the parallel angle, where the pair becomes a collision: a wisp that
    // leans on another would else be dropped where the other's next segment turns.
    const R slides = clamped_to_one((R(a.sine_none) - sine) / R(a.sine_none - a.sine_full));
    const R in = mean * slides * slides * drag;
    const R fade = smooth_step(sine, 0.5 * a.sine_fade, a.sine_fade);
    const R out = mean * drag * (R(1.0) - fade) / (R(1.0) + drag * fade);
    add_identity(w, in);
    const auto plane = fade > R(0.0);
    const R across = select(plane, (out - in) / select(plane, square, R(1.0)), R(0.0));
    add_outer(w, n, across);
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
