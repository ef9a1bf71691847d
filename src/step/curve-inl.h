// The curves of a packet's wisps: directions of their segments, and frames of their sections (M7,
// M8); docs/model.md, "Sections" and "Frames".
#if defined(MANE_STEP_CURVE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_CURVE_INL_H
#undef MANE_STEP_CURVE_INL_H
#else
#define MANE_STEP_CURVE_INL_H
#endif

#include "step/packet_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// Past a wisp's tip, its last segment goes on straight, and so does a lane without a wisp: nothing
/// bends there.
HWY_INLINE void find_directions(const PacketRows& rows) {
    Pack3 x = Pack3::load(rows.position[0]), t = broadcast({1, 0, 0});
    for (std::size_t i = 0; i < rows.tip; ++i) {
        const Pack3 next = Pack3::load(rows.position[i + 1]);
        const Direction d = direction(x, next);
        t = select(rest_value(rows.rest[i], Rest::length) > Pack(0.f), d.t, t);
        t.store(rows.scratch(i, Scratch::direction));
        d.length.store(rows.scratch(i, Scratch::length));
        d.inverse_length.store(rows.scratch(i, Scratch::inverse_length));
        x = next;
    }
}

HWY_INLINE void find_normals(const PacketRows& rows) {
    Pack3 before = Pack3::load(rows.scratch(0, Scratch::direction));
    before.store(rows.normal[0]);
    for (std::size_t i = 1; i < rows.tip; ++i) {
        const Pack3 after = Pack3::load(rows.scratch(i, Scratch::direction));
        const Bisector plane = bisector(before, after);
        plane.normal.store(rows.normal[i]);
        plane.half_cosine.store(rows.scratch(i, Scratch::half_cosine));
        plane.half_secant.store(rows.scratch(i, Scratch::half_secant));
        before = after;
    }
    before.store(rows.normal[rows.tip]);
}

HWY_INLINE void carry_axes(const PacketRows& rows, Pack3 root_axis) {
    CarriedAxes carried(Pack3::load(rows.normal[0]), root_axis);
    carried.axes.u.store(rows.u[0]);
    carried.axes.v.store(rows.v[0]);
    for (std::size_t i = 1; i <= rows.tip; ++i) {
        carried.carry_to(Pack3::load(rows.normal[i]));
        carried.axes.u.store(rows.u[i]);
        carried.axes.v.store(rows.v[i]);
        carried.tilt.store(rows.scratch(i, Scratch::tilt));
    }
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
