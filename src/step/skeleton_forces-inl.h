// §3.2: the skeleton's springs at one joint, sixteen wisps at a time; docs/model.md, "Layer 1".
#if defined(MANE_STEP_SKELETON_FORCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_SKELETON_FORCES_INL_H
#undef MANE_STEP_SKELETON_FORCES_INL_H
#else
#define MANE_STEP_SKELETON_FORCES_INL_H
#endif

#include "model/frames-inl.h"
#include "model/rest_rows.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

HWY_INLINE Pack rest_value(const float* row, Rest column) {
    return Pack::load(row + static_cast<std::uint32_t>(column) * kLanes);
}

/// A segment as its joints need it: where it points, and how its two ends move.
struct SegmentNow {
    Direction direction;
    Pack3 end_velocity;     ///< of the far end, seen from the near one
    Pack3 angular_velocity; ///< without spin
};
HWY_INLINE SegmentNow segment_now(const Direction& d, Pack3 near_velocity, Pack3 far_velocity) {
    const Pack3 v = far_velocity - near_velocity;
    return {d, v, cross(d.t, v) * d.inverse_length};
}

/// The pull of a segment's stretch spring on its near point (M1); the far one gets the opposite.
HWY_INLINE Pack3 stretch_pull(const float* rest, const SegmentNow& s) {
    const Direction& d = s.direction;
    return d.t * (rest_value(rest, Rest::stretch) * (d.length - rest_value(rest, Rest::length)) +
                  rest_value(rest, Rest::stretch_damping) * dot(s.end_velocity, d.t));
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

/// What a joint's bending spring and damper do (M2).
struct JointMoment {
    Pack3 bending; ///< works against a turn of the segment after relative to the one before
    Pack twist;    ///< on the joint's frame about its normal, from the rest bend
};
HWY_INLINE JointMoment joint_moment(const float* rest, const CurvePoint& joint,
                                    const SegmentNow& before, const SegmentNow& after,
                                    Pack thickness) {
    const Pack3 w = after.direction.t - before.direction.t;
    const Bend b = bend(dot(w, w) * Pack(0.25f), joint.half_cosine);
    const Pack u = b.angle_over_chord * dot(w, joint.u), v = b.angle_over_chord * dot(w, joint.v);
    const Pack u0 = rest_value(rest, Rest::curvature_u), v0 = rest_value(rest, Rest::curvature_v);
    const Pack3 d = joint.u * (u - u0) + joint.v * (v - v0);
    const Pack3 effective = d * b.cotangent + w * (b.remainder * dot(d, w));

    const Pack3 rate = after.angular_velocity - before.angular_velocity;
    const Pack3 bend_rate = rate - joint.normal * dot(rate, joint.normal);
    const Pack stiffness = rest_value(rest, Rest::bend) * thickness;
    return {cross(joint.normal, effective) * stiffness +
                bend_rate * rest_value(rest, Rest::bend_damping),
            (v0 * u - u0 * v) * stiffness};
}

// The twist is carried in full through bends of up to 150° (docs/model.md, "Twist").
inline constexpr float kLeastHalfCosine = 0.25881905f, kLargestTurn = 7.46410162f;

/// How the frame carried from section `a` to `b`, the next one, turns about the curve when their
/// normals move.
HWY_INLINE Pack3 holonomy_gradient(const CurvePoint& a, const CurvePoint& b) {
    return cross(a.normal, b.normal) * smaller(b.turn, Pack(kLargestTurn));
}

/// The force of a moment on a segment, and of a slope by its direction, on its far point; the near
/// one gets the opposite. A segment without direction gets none.
HWY_INLINE Pack3 couple(const Direction& d, Pack3 moment, Pack3 slope) {
    return cross(moment + cross(slope, d.t), d.t) * d.inverse_length;
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
