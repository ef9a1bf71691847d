// Section frames (M7, M8), sixteen wisps at a time; docs/model.md, "Sections" and "Frames".
#if defined(MANE_MODEL_FRAMES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_MODEL_FRAMES_INL_H
#undef MANE_MODEL_FRAMES_INL_H
#else
#define MANE_MODEL_FRAMES_INL_H
#endif

#include "base/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// A segment's direction and length. A vanishing one has no direction, and its inverse length is 0:
/// nothing turns it.
struct Direction {
    Pack3 t;
    Pack length, inverse_length;
};
HWY_INLINE Direction direction(Pack3 from, Pack3 to) {
    const Pack3 e = to - from;
    const Pack squared = dot(e, e), inverse = inverse_square_root(squared);
    return {e * inverse, squared * inverse, select_or_zero(squared > Pack(1e-12f), inverse)};
}

/// The normal of the plane that bisects two segments (M7), and half the length of the sum of their
/// directions: the cosine of half their angle. At a bend of 180° the plane is undefined; the
/// segment before decides.
struct Bisector {
    Pack3 normal;
    Pack half_cosine;
    Pack half_secant; ///< ½ / half_cosine, up to a bend of 150°
};
// The twist is carried in full through bends of up to 150° (docs/model.md, "Twist").
inline constexpr float kLargestHalfSecant = 1.93185165f, kLargestTurn = 7.46410162f;

HWY_INLINE Bisector bisector(Pack3 before, Pack3 after) {
    const Pack3 sum = before + after;
    const Pack squared = dot(sum, sum), inverse = inverse_square_root(squared);
    Bisector b{sum * inverse, squared * inverse * Pack(0.5f), inverse};
    if (!none(inverse > Pack(kLargestHalfSecant))) [[unlikely]] {
        b.normal = select(squared < Pack(1e-6f), before, b.normal);
        b.half_secant = smaller(inverse, Pack(kLargestHalfSecant));
    }
    return b;
}

/// `u` made perpendicular to the unit vector `n`, at length one.
HWY_INLINE Pack3 perpendicular_unit(Pack3 u, Pack3 n) {
    const Pack3 p = u - n * dot(u, n);
    return p * inverse_square_root(larger(dot(p, p), Pack(1e-12f)));
}

/// A section's frame (M8).
struct SectionAxes {
    Pack3 normal, u, v;

    /// The part of a vector in the section's plane.
    HWY_INLINE Pack2 in_plane(Pack3 a) const { return {dot(a, u), dot(a, v)}; }
    /// The other way round, with a part along the normal.
    HWY_INLINE Pack3 in_space(Pack2 across, Pack along) const {
        return u * across.u + v * across.v + normal * along;
    }
};
/// a + n × b and a − n × b, in the plane of the section whose normal is n.
HWY_INLINE Pack2 add_turned(Pack2 a, Pack2 b) {
    return {a.u - b.v, a.v + b.u};
}
HWY_INLINE Pack2 subtract_turned(Pack2 a, Pack2 b) {
    return {a.u + b.v, a.v - b.u};
}

/// 1 / (1 + n·n'): how much the least rotation that takes n' to n turns what lies across n'.
HWY_INLINE Pack turn_between(Pack3 before, Pack3 normal) {
    return Pack(1.f) / larger(Pack(1.f) + dot(before, normal), Pack(1e-6f));
}

/// Section axes along a curve (M8): each section's first axis is that of the section before, turned
/// by the least rotation that takes normal to normal. The quaternion's rotation of a vector across
/// its normal, written out: no trigonometry. It keeps length and right angle but for rounding, so
/// what is carried on need not wait for either to be restored.
struct CarriedAxes {
    SectionAxes axes;
    Pack3 carried; ///< the first axis, as long as rounding has made it
    Pack2 tilt;    ///< of the normal against the axes before: (n·u', n·v') / (1 + n·n')

    /// Section 0, which is attached to the head: `axis` is its first axis but for rounding.
    HWY_INLINE CarriedAxes(Pack3 normal, Pack3 axis) : carried(perpendicular_unit(axis, normal)) {
        axes = {normal, carried, cross(normal, carried)};
    }
    HWY_INLINE void carry_to(Pack3 n) {
        Pack turn = turn_between(axes.normal, n);
        const Pack2 ahead{dot(carried, n), dot(axes.v, n)};
        carried = carried - (axes.normal + n) * (ahead.u * turn);
        Pack3 u = carried * (Pack(1.5f) - Pack(0.5f) * dot(carried, carried)); // Newton, from 1
        const Mask sharp = turn > Pack(kLargestTurn);
        if (!none(sharp)) [[unlikely]] { // there, rounding grows
            carried = u = select(sharp, perpendicular_unit(carried, n), u);
            turn = smaller(turn, Pack(kLargestTurn));
        }
        axes = {n, u, cross(n, u)};
        tilt = ahead * turn;
    }
};

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
