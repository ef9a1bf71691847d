#pragma once

#include "base/parallel_for.h"
#include "interactions/character_contact.h"
#include "interactions/contact_geometry.h"
#include "interactions/wisp_detection.h"
#include "interactions/wisp_response.h"
#include "mane/world.h"
#include "model/rest_rows.h"
#include "model/state.h"
#include "step/air.h"
#include "step/held.h"
#include "step/kernels.h"
#include "step/schedule.h"

#include <chrono>

namespace mane {

/// All that a step of §5.1 reads and writes. Rest data, live state and scratch are apart.
struct Simulation {
    Simulation(const SimulationDesc& desc, const Groom& groom, const RunOptions& options);

    // fixed
    SimulationDesc desc;
    Groom groom;
    Layout layout;
    RestRows rest;
    std::vector<HalfLine> lines;
    Schedule schedule;
    Air air;
    Kernels kernels;

    // live
    State state;
    Rows root_axis;   ///< u₀ now, one row per packet
    RootMotion roots; ///< over the present block
    Held held;        ///< over the present block
    ContactGeometry contact_geometry;
    WispDetection wisp_detection;
    WispResponse wisp_response;
    CharacterContacts character_contacts;
    std::vector<ContactBody> bodies; ///< their surfaces over the present block
    Vec3d origin;                    ///< [m] world position of the state's origin
    std::vector<Reaction> reactions; ///< penetration reactions of the present frame

    // scratch
    SectionFrames frames;
    Rows scratch; ///< of the forces
    Rows wind;    ///< [m/s] at every skeleton point, where the air is not uniform
    Threads threads;
    Statistics statistics;
    std::function<void(const StageSpan&)> on_stage;

    HairView hair() const { return {groom, layout, rest, state, frames, lines}; }
    KernelData kernel_data();
    /// Runs a kernel over all packets, side by side.
    template <typename Work> void for_packets(Work&& work) {
        threads.run_ranges(layout.packets().size(), kPacketsPerChunk, work);
    }
};

/// Adds the time of a scope to a stage, and shows it to who wants to see it.
class StageTimer {
  public:
    StageTimer(Simulation& simulation, Stage stage)
        : simulation_(simulation), stage_(stage), begin_(Clock::now()) {}
    ~StageTimer() {
        const Clock::time_point end = Clock::now();
        simulation_.statistics.stage_seconds[static_cast<std::size_t>(stage_)] +=
            std::chrono::duration<double>(end - begin_).count();
        if (simulation_.on_stage)
            simulation_.on_stage({stage_, begin_, end});
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

  private:
    using Clock = std::chrono::steady_clock;
    Simulation& simulation_;
    Stage stage_;
    Clock::time_point begin_;
};

} // namespace mane
