// Stage 1 of §5.1: springs of the skeleton (§3.2) and the envelope (§3.3), gravity and air, sixteen
// wisps at a time. Several passes over a packet's sections, each so short that the processor, which
// looks some hundred instructions ahead, has a few sections at hand: one alone is a long chain of
// results that wait for each other.
#if defined(MANE_STEP_FORCES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_FORCES_INL_H
#undef MANE_STEP_FORCES_INL_H
#else
#define MANE_STEP_FORCES_INL_H
#endif

#include "step/curve-inl.h"
#include "step/envelope_forces-inl.h"
#include "step/skeleton_forces-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

template <int kFixedPoints, bool kSquare> struct PacketForces {
    const KernelData& data;
    StepPacks step{data};
    Ring<kFixedPoints> ring{data.half_lines};

    HWY_INLINE void operator()(std::size_t packet, std::size_t lane) const {
        const PacketRows rows(data, packet, lane);
        find_directions(rows);
        for (std::size_t i = 0; i < rows.tip; ++i)
            stretch_segment(rows, i);
        find_normals(rows);
        carry_axes(rows, Pack3::load(data.root_axis.row(packet) + lane));
        for (std::size_t i = 2; i <= rows.tip; ++i)
            squeeze_envelope(rows, i, ring);
        const Pack power = Pack::load(data.rest.thickness_power().row(packet) + lane);
        for (std::size_t i = 1; i < rows.tip; ++i)
            bend_joint(rows, i, thickness(rows, i, power));
        add_skeleton_forces(rows);
        // From tip to root, too: what is needed first has been there longest.
        for (std::size_t i = rows.tip; i >= 2; --i)
            accelerate_section(rows, i, step, ring);
    }

  private:
    HWY_INLINE Pack thickness(const PacketRows& rows, std::size_t i, Pack power) const {
        return thickness_factor<kSquare>(ring.sum(ring.load(rows.radius[i])) *
                                             rest_value(rows.rest[i], Rest::inverse_radius_sum),
                                         power);
    }
};

template <int kFixedPoints, bool kSquare>
void forces_of_packets(const KernelData& data, std::size_t first, std::size_t last) {
    const PacketForces<kFixedPoints, kSquare> process{data};
    for (std::size_t p = first; p < last; ++p)
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
            process(p, lane);
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
    for (std::size_t p = first; p < last; ++p)
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes) {
            const PacketRows rows(data, p, lane);
            find_directions(rows);
            find_normals(rows);
            carry_axes(rows, Pack3::load(data.root_axis.row(p) + lane));
        }
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
