// §3.2: the skeleton's springs, sixteen wisps at a time; docs/model.md, "Layer 1" and "In a
// section's axes".
#if defined(MANE_STEP_SKELETON_FORCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_SKELETON_FORCES_INL_H
#undef MANE_STEP_SKELETON_FORCES_INL_H
#else
#define MANE_STEP_SKELETON_FORCES_INL_H
#endif

#include "step/packet_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// The tension of segment i's stretch spring (M1), and how the segment turns, without its spin.
HWY_INLINE void stretch_segment(const PacketRows& rows, std::size_t i) {
    const float* rest = rows.rest[i];
    const Pack3 t = Pack3::load(rows.scratch(i, Scratch::direction)),
                v = Pack3::load(rows.velocity[i + 1]) - Pack3::load(rows.velocity[i]);
    const Pack longer =
        Pack::load(rows.scratch(i, Scratch::length)) - rest_value(rest, Rest::length);
    (rest_value(rest, Rest::stretch) * longer + rest_value(rest, Rest::stretch_damping) * dot(v, t))
        .store(rows.scratch(i, Scratch::tension));
    (cross(t, v) * Pack::load(rows.scratch(i, Scratch::inverse_length)))
        .store(rows.scratch(i, Scratch::angular_velocity));
}

/// M3: bending stiffness grows with the section's mean radius to the power p.
template <bool kSquare> HWY_INLINE Pack thickness_factor(Pack ratio, Pack power_p) {
    Pack factor;
    if constexpr (kSquare) {
        factor = ratio * ratio;
    } else {
        factor = power(larger(ratio, Pack(1e-6f)), power_p);
    }
    return smaller(larger(factor, Pack(0.25f)), Pack(4.f));
}

/// What the bending spring and damper of joint i do (M2), in its section's plane: a moment against
/// a turn of the segment after relative to the one before, and one on the joint's frame about its
/// normal, from the rest bend.
HWY_INLINE void bend_joint(const PacketRows& rows, std::size_t i, Pack thickness) {
    const float* rest = rows.rest[i];
    const SectionAxes axes = rows.axes(i);
    const Bend b = bend(Pack::load(rows.scratch(i, Scratch::half_cosine)));
    const Pack2 h = axes.in_plane(Pack3::load(rows.scratch(i, Scratch::direction))),
                curvature = h * b.curvature,
                rest_curvature{rest_value(rest, Rest::curvature_u),
                               rest_value(rest, Rest::curvature_v)};
    const Pack2 d = curvature - rest_curvature,
                effective = d * b.cotangent + h * (b.remainder * dot(d, h));
    const Pack2 rate = axes.in_plane(Pack3::load(rows.scratch(i, Scratch::angular_velocity)) -
                                     Pack3::load(rows.scratch(i - 1, Scratch::angular_velocity)));
    const Pack stiffness = rest_value(rest, Rest::bend) * thickness;
    h.store(rows.scratch(i, Scratch::half_chord));
    add_turned(rate * rest_value(rest, Rest::bend_damping), effective * stiffness)
        .store(rows.scratch(i, Scratch::bending));
    (wedge(curvature, rest_curvature) * stiffness).store(rows.scratch(i, Scratch::twist));
}

/// The forces of a joint on the far points of its two segments; their near points get the opposite.
struct JointForces {
    Pack3 before, after;
};
/// `twisted`: what the twist that is handed on from the tip makes of the tilts of the normals.
HWY_INLINE JointForces joint_forces(const PacketRows& rows, std::size_t i, Pack2 twisted) {
    const SectionAxes axes = rows.axes(i);
    const Pack c = Pack::load(rows.scratch(i, Scratch::half_cosine)),
               before = Pack::load(rows.scratch(i - 1, Scratch::inverse_length)),
               after = Pack::load(rows.scratch(i, Scratch::inverse_length));
    const Pack2 h = Pack2::load(rows.scratch(i, Scratch::half_chord)),
                bending = Pack2::load(rows.scratch(i, Scratch::bending));
    const Pack half_twist = Pack::load(rows.scratch(i, Scratch::twist)) * Pack(0.5f);
    // what is alike on both segments, and what is opposite
    const Pack p = wedge(h, twisted);
    const Pack2 alike = add_turned(h * p, twisted), opposite = bending * c + h * half_twist;
    const Pack alike_along = wedge(h, bending), opposite_along = c * p;
    return {
        axes.in_space(subtract_turned(alike, opposite) * before,
                      (alike_along - opposite_along) * before),
        axes.in_space(add_turned(alike, opposite) * after, (alike_along + opposite_along) * after)};
}

/// Forces of all joints and segments on the skeleton's points, from tip to root.
HWY_INLINE void add_skeleton_forces(const PacketRows& rows) {
    Pack twist(0.f);
    Pack2 twisted_after{Pack(0.f), Pack(0.f)};
    Pack3 force_after = broadcast({}), before_after = force_after;
    for (std::size_t i = rows.tip - 1; i >= 1; --i) {
        twist = twist + Pack::load(rows.scratch(i, Scratch::twist));
        const Pack2 twisted = Pack2::load(rows.scratch(i, Scratch::tilt)) * twist;
        const Pack half_secant = Pack::load(rows.scratch(i, Scratch::half_secant));
        const JointForces f = joint_forces(rows, i, (twisted + twisted_after) * half_secant);
        const Pack3 outward = f.after - Pack3::load(rows.scratch(i, Scratch::direction)) *
                                            Pack::load(rows.scratch(i, Scratch::tension));
        // Of the joints that act on the section after, this is the last.
        (force_after + outward).store(rows.scratch(i + 1, Scratch::force));
        force_after = f.before - outward - before_after;
        before_after = f.before;
        twisted_after = twisted;
    }
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
