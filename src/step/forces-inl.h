// Stage 1 of §5.1: springs of the skeleton (§3.2) and the envelope (§3.3), gravity and air;
// docs/model.md has the equations. One wisp per lane, from root to tip.
#if defined(MANE_STEP_FORCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_FORCES_INL_H
#undef MANE_STEP_FORCES_INL_H
#else
#define MANE_STEP_FORCES_INL_H
#endif

#include "model/frames-inl.h"
#include "step/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

HWY_INLINE Pack rest_value(const float* row, Rest column) {
    return Pack::load(row + static_cast<std::uint32_t>(column) * kLanes);
}

struct Axes {
    Pack3 u, v, normal;
};

/// A segment as its neighbours need it: direction, and angular velocity of the direction.
struct SegmentNow {
    Direction direction;
    Pack3 angular_velocity;
};
HWY_INLINE SegmentNow segment_now(Pack3 x0, Pack3 x1, Pack3 v0, Pack3 v1) {
    const Direction d = direction(x0, x1);
    return {d, cross(d.t, v1 - v0) * (Pack(1.f) / d.length)};
}

/// Forces of the stretch spring of a segment on its far point; the near point gets the opposite.
HWY_INLINE Pack3 stretch_force(const float* rest, const Direction& d, Pack3 v0, Pack3 v1) {
    const Pack tension =
        rest_value(rest, Rest::stretch) * (d.length - rest_value(rest, Rest::length)) +
        rest_value(rest, Rest::stretch_damping) * dot(v1 - v0, d.t);
    return -(d.t * tension);
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

/// The bending moment of a joint (M2): the exact gradient of ½k|κ − κ⁰|², and a damper on the
/// bend's rate.
HWY_INLINE Pack3 bending_moment(const float* rest, const SegmentNow& before,
                                const SegmentNow& after, const Axes& axes, Pack half_angle_cosine,
                                Pack thickness) {
    const Pack3 w = after.direction.t - before.direction.t;
    const Pack ww = dot(w, w);
    const Bend b = bend(ww * Pack(0.25f), half_angle_cosine);
    const Pack du = b.angle_over_chord * dot(w, axes.u) - rest_value(rest, Rest::curvature_u);
    const Pack dv = b.angle_over_chord * dot(w, axes.v) - rest_value(rest, Rest::curvature_v);
    const Pack3 d = axes.u * du + axes.v * dv;
    const Pack3 effective = d * b.cotangent + w * (b.remainder * dot(d, w));

    const Pack3 rate = after.angular_velocity - before.angular_velocity;
    const Pack3 bend_rate = rate - axes.normal * dot(rate, axes.normal);
    return cross(axes.normal, effective) * (rest_value(rest, Rest::bend) * thickness) +
           bend_rate * rest_value(rest, Rest::bend_damping);
}

/// Velocities of a skeleton point and its envelope points from the forces on them (M9, M13).
template <int kFixedPoints> HWY_INLINE void finish_section(const KernelData& data, std::size_t row,
                                                           std::size_t lane, Pack3 force,
                                                           const Axes& axes) {
    const int points = kFixedPoints ? kFixedPoints : static_cast<int>(data.half_lines.size());
    const float* rest = data.rest.row(row) + lane;
    const float* radii = data.state.radius.row(row) + lane;
    float* rates = data.state.radius_rate.row(row) + lane;
    const Pack h(data.step), drag(data.drag);

    Pack r[kMaxEnvelopePoints], rate[kMaxEnvelopePoints], q[kMaxEnvelopePoints];
    const Pack stiffness = rest_value(rest, Rest::radial) * Pack(0.5f),
               damping = rest_value(rest, Rest::radial_damping);
    for (int k = 0; k < points; ++k) { // M11
        r[k] = Pack::load(radii + k * kLanes);
        rate[k] = Pack::load(rates + k * kLanes);
        const Pack r0 = Pack::load(rest + (RestRows::kColumns + k) * kLanes);
        const Pack ratio = larger(r[k] / larger(r0, Pack(1e-9f)), Pack(0.15f));
        q[k] = stiffness * r0 * (Pack(1.f) / ratio - ratio) - damping * rate[k];
    }
    const Pack ring = rest_value(rest, Rest::ring),
               ring_damping = rest_value(rest, Rest::ring_damping);
    const Pack cosine(data.half_lines[1].cosine);
    for (int k = 0; k < points; ++k) { // M12
        const int next = k + 1 < points ? k + 1 : 0;
        const Pack a = r[k] - cosine * r[next], b = r[next] - cosine * r[k];
        const Pack length = square_root(larger(a * r[k] + b * r[next], Pack(1e-12f)));
        const Pack inverse = Pack(1.f) / length;
        const Pack length_rate = (a * rate[k] + b * rate[next]) * inverse;
        const Pack rest_length = Pack::load(rest + (RestRows::kColumns + points + k) * kLanes);
        const Pack tension = (ring * (length - rest_length) + ring_damping * length_rate) * inverse;
        q[k] = q[k] - tension * a;
        q[next] = q[next] - tension * b;
    }

    Pack qu(0.f), qv(0.f);
    for (int k = 0; k < points; ++k) {
        qu = qu + q[k] * Pack(data.half_lines[k].cosine);
        qv = qv + q[k] * Pack(data.half_lines[k].sine);
    }
    if (!data.ablation.reaction)
        qu = qv = Pack(0.f);
    const Pack3 total = force - axes.u * qu - axes.v * qv;
    const Pack3 a =
        total * rest_value(rest, Rest::inverse_mass_across) +
        axes.normal * (dot(total, axes.normal) * rest_value(rest, Rest::inverse_mass_extra));

    const Pack inverse_mass = rest_value(rest, Rest::inverse_envelope_mass);
    const Mask moves = inverse_mass > Pack(0.f);
    float* velocity = data.state.velocity.row(row) + lane;
    const Pack3 v = Pack3::load(velocity);
    const Pack3 air = data.wind
                          ? Pack3::load(data.wind->row(row) + lane)
                          : Pack3{data.uniform_wind.x, data.uniform_wind.y, data.uniform_wind.z};
    const Pack3 gravity{data.gravity.x, data.gravity.y, data.gravity.z};
    const Pack3 free =
        select_or_zero(moves, gravity + (air - v) * drag); // alike at every point of the section
    without_tiny(v + (free + a) * h).store(velocity);

    const Pack au = dot(a, axes.u), av = dot(a, axes.v);
    for (int k = 0; k < points; ++k) {
        const Pack along =
            au * Pack(data.half_lines[k].cosine) + av * Pack(data.half_lines[k].sine);
        without_tiny(rate[k] + (q[k] * inverse_mass - drag * rate[k] - along) * h)
            .store(rates + k * kLanes);
    }
}

HWY_INLINE void store_axes(SectionFrames& frames, std::size_t row, std::size_t lane,
                           const Axes& axes) {
    axes.u.store(frames.u.row(row) + lane);
    axes.v.store(frames.v.row(row) + lane);
    axes.normal.store(frames.normal.row(row) + lane);
}

/// Root to tip over the wisps of one vector. A joint acts on three points, so a section is finished
/// one joint after its own.
template <int kFixedPoints, bool kSquare>
HWY_INLINE void forces_of_lanes(const KernelData& data, const Packet& packet,
                                std::size_t packet_index, std::size_t lane) {
    const State& state = data.state;
    const auto position = [&](std::size_t row) {
        return Pack3::load(state.position.row(row) + lane);
    };
    const auto velocity = [&](std::size_t row) {
        return Pack3::load(state.velocity.row(row) + lane);
    };
    const int points = kFixedPoints ? kFixedPoints : static_cast<int>(data.half_lines.size());
    const Pack thickness_power = Pack::load(data.rest.thickness_power().row(packet_index) + lane);

    const std::size_t root = packet.first_row;
    Pack3 x = position(root + 1), v = velocity(root + 1);
    SegmentNow before = segment_now(position(root), x, velocity(root), v);
    Axes previous;
    previous.normal = before.direction.t;
    previous.u =
        perpendicular_unit(Pack3::load(data.root_axis.row(packet_index) + lane), previous.normal);
    previous.v = cross(previous.normal, previous.u);
    store_axes(data.frames, root, lane, previous);

    const Pack3 zero{0.f, 0.f, 0.f};
    Pack3 force_before = zero, force = zero; // on the sections before and at the joint
    for (std::size_t i = 1; i < packet.rows; ++i) {
        const std::size_t row = root + i;
        const float* rest = data.rest.row(row) + lane;
        const Mask goes_on = rest_value(rest, Rest::length) > Pack(0.f);

        // The segment after this section; past the tip, the one before goes on straight.
        Pack3 x_next = x, v_next = v;
        SegmentNow after = before;
        if (i + 1 < packet.rows) {
            x_next = position(row + 1);
            v_next = velocity(row + 1);
            after = segment_now(x, x_next, v, v_next);
            after.direction.t = select(goes_on, after.direction.t, before.direction.t);
        }
        const Bisector plane = bisector(before.direction.t, after.direction.t);
        Axes axes;
        axes.normal = plane.normal;
        axes.u = transport(previous.u, previous.normal, axes.normal);
        axes.v = cross(axes.normal, axes.u);
        store_axes(data.frames, row, lane, axes);

        Pack3 force_after = zero;
        if (i + 1 < packet.rows) {
            const Pack3 pull = stretch_force(rest, after.direction, v, v_next);
            force_after = pull;
            force = force - pull;

            Pack radii(0.f);
            for (int k = 0; k < points; ++k)
                radii = radii + Pack::load(state.radius.row(row) + k * kLanes + lane);
            const Pack thickness = thickness_factor<kSquare>(
                radii * rest_value(rest, Rest::inverse_radius_sum), thickness_power);
            const Pack3 moment = bending_moment(rest, before, after, axes, plane.cosine, thickness);
            const Pack3 far =
                cross(moment, after.direction.t) * (Pack(1.f) / after.direction.length);
            const Pack3 near =
                cross(moment, before.direction.t) * (Pack(1.f) / before.direction.length);
            force_after = force_after - far;
            force = force + far + near;
            force_before = force_before - near;
        }
        if (i >= 2)
            finish_section<kFixedPoints>(data, row - 1, lane, force_before, previous);
        force_before = force;
        force = force_after;
        previous = axes;
        before = after;
        x = x_next;
        v = v_next;
    }
    finish_section<kFixedPoints>(data, root + packet.rows - 1, lane, force_before, previous);
}

template <int kFixedPoints, bool kSquare>
void forces_of_packets(const KernelData& data, std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
            forces_of_lanes<kFixedPoints, kSquare>(data, data.layout.packets()[p], p, lane);
}

void process_forces(const KernelData& data, std::size_t first, std::size_t last) {
    const bool four = data.half_lines.size() == 4, square = data.rest.square_thickness();
    if (four && square)
        return forces_of_packets<4, true>(data, first, last);
    if (four)
        return forces_of_packets<4, false>(data, first, last);
    if (square)
        return forces_of_packets<0, true>(data, first, last);
    forces_of_packets<0, false>(data, first, last);
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
