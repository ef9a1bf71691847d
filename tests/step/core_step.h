#pragma once

#include "base/random.h"
#include "reference/twin.h"
#include "step/core_hair.h"
#include "step/kernels.h"

namespace mane {

inline constexpr float kStep = 1e-4f; // [s]

/// The core's hair with all that its kernels need for a step, in air that moves everywhere
/// otherwise.
struct CoreStep : CoreHair {
    explicit CoreStep(const Groom& g)
        : CoreHair(g), root_axis(layout.packets().size(), 3), roots(layout.packets().size()),
          wind(layout.rows(), 3), scratch(force_scratch(layout)) {}

    using CoreHair::take;
    void take(const Frame& frame) {
        CoreHair::take(frame);
        for (std::uint32_t s = 0; s < groom.section_count(); ++s)
            wind.set(layout.slot(s), air_at(s));
        for (std::size_t w = 0; w < groom.wisp_count(); ++w)
            root_axis.set(packet_lane(w), frame.first_axis[w]);
    }
    /// Where a wisp's own numbers are in rows of one per packet.
    Slot packet_lane(std::size_t w) const {
        for (std::uint32_t p = 0; p < layout.packets().size(); ++p)
            for (std::uint32_t lane = 0; lane < kLanes; ++lane)
                if (layout.packets()[p].wisp[lane] == w)
                    return {p, lane};
        return {};
    }
    static Vec3 air_at(std::uint32_t section) {
        const Random random(99, section);
        return {random.between(0, -3, 3), random.between(1, -3, 3), random.between(2, -3, 3)};
    }
    KernelData data() {
        return {.layout = layout,
                .rest = rest,
                .roots = roots,
                .half_lines = lines,
                .state = state,
                .frames = frames,
                .scratch = scratch,
                .root_axis = root_axis,
                .wind = &wind,
                .uniform_wind = {},
                .gravity = {0.3f, -9.81f, 0.1f},
                .drag = 3,
                .step = kStep};
    }

    Rows root_axis;
    RootMotion roots;
    Rows wind;
    Rows scratch;
};

/// The twin of it, in the same air.
inline reference::Hair twin_of(const Groom& groom, const Frame& frame) {
    reference::Hair hair(groom);
    set_state(hair, frame);
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        for (std::uint32_t i = 0; i < groom.sections(w); ++i)
            hair.wisps[w].air[i] = Vec3d(CoreStep::air_at(groom.first_section[w] + i));
    return hair;
}

} // namespace mane
