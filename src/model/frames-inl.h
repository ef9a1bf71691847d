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
    Pack length;
};
HWY_INLINE Direction direction(Pack3 from, Pack3 to) {
    const Pack3 e = to - from;
    const Pack length = larger(square_root(dot(e, e)), Pack(1e-6f));
    return {e * (Pack(1.f) / length), length};
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
    const Pack length = square_root(dot(sum, sum));
    const Pack3 normal = sum * (Pack(1.f) / larger(length, Pack(1e-3f)));
    return {select(length < Pack(1e-3f), before, normal), length * Pack(0.5f)};
}

/// `u` made perpendicular to the unit vector `n`, at length one.
HWY_INLINE Pack3 perpendicular_unit(Pack3 u, Pack3 n) {
    const Pack3 p = u - n * dot(u, n);
    return p * (Pack(1.f) / larger(square_root(dot(p, p)), Pack(1e-6f)));
}

/// The axis `u` of the section with normal `from`, turned by the least rotation that takes `from`
/// to `to` (M8). The quaternion's rotation of a vector perpendicular to `from`, written out: no
/// trigonometry.
HWY_INLINE Pack3 transport(Pack3 u, Pack3 from, Pack3 to) {
    const Pack3 sum = from + to;
    const Pack scale = dot(u, to) / larger(Pack(1.f) + dot(from, to), Pack(1e-6f));
    return perpendicular_unit(u - sum * scale, to);
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
