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

/// A segment's direction and length; a vanishing one has no direction, but every number stays
/// finite.
struct Direction {
    Pack3 t;
    Pack length, inverse_length;
};
HWY_INLINE Direction direction(Pack3 from, Pack3 to) {
    const Pack3 e = to - from;
    const Pack squared = larger(dot(e, e), Pack(1e-12f));
    const Pack inverse = inverse_square_root(squared);
    return {e * inverse, squared * inverse, inverse};
}

/// The normal of the plane that bisects two segments (M7), and half the length of the sum of their
/// directions: the cosine of half their angle. At a bend of 180° the plane is undefined; the
/// segment before decides.
struct Bisector {
    Pack3 normal;
    Pack cosine;
};
HWY_INLINE Bisector bisector(Pack3 before, Pack3 after) {
    const Pack3 sum = before + after;
    const Pack squared = dot(sum, sum), inverse = inverse_square_root(larger(squared, Pack(1e-6f)));
    return {select(squared < Pack(1e-6f), before, sum * inverse), squared * inverse * Pack(0.5f)};
}

/// `u` made perpendicular to the unit vector `n`, at length one.
HWY_INLINE Pack3 perpendicular_unit(Pack3 u, Pack3 n) {
    const Pack3 p = u - n * dot(u, n);
    return p * inverse_square_root(larger(dot(p, p), Pack(1e-12f)));
}

/// A section of the curve with its frame (M8), and the segment after it; past the tip, the segment
/// before goes on straight.
struct CurvePoint {
    Direction after;
    Pack half_cosine; ///< of the bend between the two segments
    Pack3 normal, u, v;
    Pack turn; ///< 1 / (1 + n·n of the section before): how much the frame turns between the two
};

/// Section 0, whose frame is attached to the head: `axis` is its first axis but for rounding.
HWY_INLINE CurvePoint curve_root(Pack3 x0, Pack3 x1, Pack3 axis) {
    const Direction d = direction(x0, x1);
    const Pack3 u = perpendicular_unit(axis, d.t);
    return {d, Pack(1.f), d.t, u, cross(d.t, u), Pack(0.5f)};
}

/// The section after `before`: its axis is that of the section before, turned by the least rotation
/// that takes normal to normal (M8). The quaternion's rotation of a vector across its normal,
/// written out: no trigonometry.
HWY_INLINE CurvePoint curve_point(const CurvePoint& before, Direction after) {
    const Bisector plane = bisector(before.after.t, after.t);
    const Pack turn = Pack(1.f) / larger(Pack(1.f) + dot(before.normal, plane.normal), Pack(1e-6f));
    const Pack3 u = perpendicular_unit(before.u - (before.normal + plane.normal) *
                                                      (dot(before.u, plane.normal) * turn),
                                       plane.normal);
    return {after, plane.cosine, plane.normal, u, cross(plane.normal, u), turn};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
