// Stage 1 of §5.1: springs of the skeleton (§3.2) and the envelope (§3.3), gravity and air, sixteen
// wisps at a time. Two ways along each wisp: its curve from root to tip, since frames are carried
// that way; its forces from tip to root, since the twist of rest bends is.
#if defined(MANE_STEP_FORCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_FORCES_INL_H
#undef MANE_STEP_FORCES_INL_H
#else
#define MANE_STEP_FORCES_INL_H
#endif

#include "step/envelope_forces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// Calls `use(section, point)` for every section of a packet's wisps, from root to tip.
template <typename Use> HWY_INLINE void
along_curve(const KernelData& data, std::size_t packet_index, std::size_t lane, Use&& use) {
    const Packet& packet = data.layout.packets()[packet_index];
    const std::size_t root = packet.first_row;
    const auto position = [&](std::size_t i) {
        return Pack3::load(data.state.position.row(root + i) + lane);
    };
    Pack3 x = position(1);
    CurvePoint point =
        curve_root(position(0), x, Pack3::load(data.root_axis.row(packet_index) + lane));
    use(0, point);
    for (std::size_t i = 1; i < packet.rows; ++i) {
        Direction after = point.after;
        if (i + 1 < packet.rows) {
            const Mask goes_on =
                rest_value(data.rest.row(root + i) + lane, Rest::length) > Pack(0.f);
            const Pack3 next = position(i + 1);
            after = direction(x, next);
            after.t = select(goes_on, after.t, point.after.t);
            x = next;
        }
        point = curve_point(point, after);
        use(i, point);
    }
}

HWY_INLINE void store_frame(const KernelData& data, std::size_t row, std::size_t lane,
                            const CurvePoint& point) {
    point.u.store(data.frames.u.row(row) + lane);
    point.v.store(data.frames.v.row(row) + lane);
    point.normal.store(data.frames.normal.row(row) + lane);
}

/// What the way back needs of the curve beside its frames: a row of scratch per section of a
/// packet.
HWY_INLINE void store_curve(float* row, const CurvePoint& point) {
    point.after.t.store(row);
    point.after.length.store(row + 3 * kLanes);
    point.after.inverse_length.store(row + 4 * kLanes);
    point.half_cosine.store(row + 5 * kLanes);
    point.turn.store(row + 6 * kLanes);
}
HWY_INLINE CurvePoint load_curve(const KernelData& data, const float* curve, std::size_t row,
                                 std::size_t lane) {
    return {{Pack3::load(curve), Pack::load(curve + 3 * kLanes), Pack::load(curve + 4 * kLanes)},
            Pack::load(curve + 5 * kLanes),
            Pack3::load(data.frames.normal.row(row) + lane),
            Pack3::load(data.frames.u.row(row) + lane),
            Pack3::load(data.frames.v.row(row) + lane),
            Pack::load(curve + 6 * kLanes)};
}

template <int kFixedPoints, bool kSquare>
HWY_INLINE void forces_of_lanes(const KernelData& data, std::size_t first_packet,
                                std::size_t packet_index, std::size_t lane) {
    const Packet& packet = data.layout.packets()[packet_index];
    const std::size_t root = packet.first_row;
    const int points = kFixedPoints ? kFixedPoints : static_cast<int>(data.half_lines.size());
    const std::size_t curve_row = (first_packet / kPacketsPerChunk) * data.layout.most_rows();
    const auto point = [&](std::size_t i) {
        return load_curve(data, data.curve.row(curve_row + i) + lane, root + i, lane);
    };
    const auto velocity = [&](std::size_t i) {
        return Pack3::load(data.state.velocity.row(root + i) + lane);
    };
    const Pack thickness_power = Pack::load(data.rest.thickness_power().row(packet_index) + lane);

    along_curve(data, packet_index, lane, [&](std::size_t i, const CurvePoint& found) {
        store_frame(data, root + i, lane, found);
        store_curve(data.curve.row(curve_row + i) + lane, found);
    });

    const std::size_t tip = packet.rows - 1;
    CurvePoint next = point(tip), joint = point(tip - 1);
    Pack3 v = velocity(tip - 1);
    SegmentNow after = segment_now(joint.after, v, velocity(tip));
    Pack3 carried_after = holonomy_gradient(joint, next);
    Pack twist_after(0.f);
    Pack3 force_next{0.f, 0.f, 0.f}, force{0.f, 0.f, 0.f}; // on the section after, and at the joint
    for (std::size_t i = tip - 1; i >= 1; --i) {
        const float* rest = data.rest.row(root + i) + lane;
        const CurvePoint previous = point(i - 1);
        const Pack3 v_previous = velocity(i - 1);
        const SegmentNow before = segment_now(previous.after, v_previous, v);

        Pack radii(0.f);
        for (int k = 0; k < points; ++k)
            radii = radii + Pack::load(data.state.radius.row(root + i) + k * kLanes + lane);
        const Pack thickness = thickness_factor<kSquare>(
            radii * rest_value(rest, Rest::inverse_radius_sum), thickness_power);
        const JointMoment m = joint_moment(rest, joint, before, after, thickness);

        const Pack3 carried = holonomy_gradient(previous, joint);
        const Pack twist = twist_after + m.twist;
        const Pack3 slope = -(carried * twist + carried_after * twist_after) *
                            (Pack(0.5f) / larger(joint.half_cosine, Pack(kLeastHalfCosine)));
        const Pack3 own_twist = joint.normal * (m.twist * Pack(0.5f));
        const Pack3 far = couple(after.direction, own_twist - m.bending, slope);
        const Pack3 near = couple(before.direction, own_twist + m.bending, slope);
        const Pack3 pull = stretch_pull(rest, after);

        // Of the joints that act on the section after, this is the last.
        accelerate_section<kFixedPoints>(data, root + i + 1, lane, force_next + far - pull, next);
        force_next = force + pull - far + near;
        force = -near;
        next = joint;
        joint = previous;
        v = v_previous;
        after = before;
        carried_after = carried;
        twist_after = twist;
    }
}

template <int kFixedPoints, bool kSquare>
void forces_of_packets(const KernelData& data, std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p)
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
            forces_of_lanes<kFixedPoints, kSquare>(data, first, p, lane);
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

/// The section frames alone, for a detection.
void section_frames(const KernelData& data, std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
        const std::size_t root = data.layout.packets()[p].first_row;
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
            along_curve(data, p, lane, [&](std::size_t i, const CurvePoint& point) {
                store_frame(data, root + i, lane, point);
            });
    }
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
