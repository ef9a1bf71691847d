#include "step/world_data.h"

#include "character/ease.h"
#include "groom/stability.h"
#include "step/check_desc.h"
#include "step/placement.h"
#include "step/roots.h"
#include "step/step.h"

#include <cmath>
#include <string>

namespace mane {

World::Data::Data(const SimulationDesc& desc, const Groom& groom, std::vector<Body> bodies,
                  double start_time, const RunOptions& options)
    : simulation(desc, groom, options),
      cast(std::move(bodies), options.instruction_set), epoch_{start_time, 0, simulation.schedule} {
    frame.time = start_time;
    head_middle = middle_of_roots();
    require_stable_step(simulation.groom, double{desc.air.drag},
                        simulation.schedule.step_seconds());
    simulation.origin = nearby_origin(start_time);
    simulation.bodies = cast.contact_bodies();
    cast.begin(start_time, simulation.origin);
    place_groom(simulation, cast, start_time);
    place_roots(start_time);
    const KernelData data = simulation.kernel_data();
    simulation.kernels.section_frames(data, 0, simulation.layout.packets().size());
    check_roots(simulation.hair(), simulation.bodies, cast.names());
    publish();
}

/// The design's roots on average: about the middle of the scalp.
Vec3d World::Data::middle_of_roots() const {
    const Groom& groom = simulation.groom;
    Vec3d sum;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        sum += Vec3d(groom.position[groom.first_section[w] + 1]);
    return sum / static_cast<double>(groom.wisp_count());
}

/// An origin near the head, on a coarse binary grid: moving the state between two such origins
/// rounds next to nothing.
Vec3d World::Data::nearby_origin(double time) const {
    const Vec3d p = cast.on_head(head_middle, time);
    const auto snap = [](double x) { return std::floor(x * 16 + 0.5) / 16; };
    return {snap(p.x), snap(p.y), snap(p.z)};
}

void World::Data::follow_head(double time) {
    const Vec3d next = nearby_origin(time);
    const Vec3 shift(simulation.origin - next);
    simulation.origin = next;
    for (std::uint32_t section = 0; section < simulation.groom.section_count(); ++section) {
        const Slot slot = simulation.layout.slot(section);
        simulation.state.position.set(slot, simulation.state.position.vec(slot) + shift);
    }
    cast.begin(time, simulation.origin);
}

/// Leads the roots from where the bodies are posed now to where they will be `seconds` later, and
/// poses the bodies there.
void World::Data::enter_block(double time, double seconds) {
    simulation.roots.seconds = static_cast<float>(seconds);
    lead_roots(time);
    follow_roots(0);
    cast.advance(time + seconds, seconds, simulation.origin);
    lead_roots(time + seconds);
    follow_roots(1);
}

void World::Data::follow_roots(int end) {
    follow_scalp(simulation.groom, simulation.layout, cast.body(0).mesh, cast.vertices(0),
                 cast.velocities(0), end, simulation.roots, root_change_);
}

/// Roots of another groom are reached at the frame's end.
void World::Data::lead_roots(double time) {
    if (root_change_.from.empty())
        return;
    const double seconds = next_time() - frame.time;
    const Slope share = ease((time - frame.time) / seconds);
    root_change_.share = share.value;
    root_change_.rate = share.rate / seconds;
}

/// Puts the kinematic sections, with their velocities, where the bodies have them at `time`, and
/// the bodies there.
void World::Data::place_roots(double time) {
    cast.begin(time, simulation.origin);
    enter_block(time, simulation.schedule.step_seconds());
    const KernelData data = simulation.kernel_data();
    const std::size_t packets = simulation.layout.packets().size();
    simulation.kernels.move_root_velocities(data, 0, 0, packets);
    simulation.kernels.place_roots(data, 0, 0, packets);
    cast.begin(time, simulation.origin);
}

void World::Data::advance() {
    const Schedule& schedule = simulation.schedule;
    const double end_of_frame = next_time();
    epoch_ = epoch();
    follow_head(step_time(0));
    if (simulation.desc.wisps.mode == WispContactMode::off)
        simulation.wisp_detection.forget();
    simulation.reactions.clear();
    for (std::uint32_t b = 0; b < schedule.blocks(); ++b) {
        const std::uint32_t begin = schedule.block_begin(b), end = schedule.block_begin(b + 1);
        const double time = step_time(begin), seconds = (end - begin) * schedule.step_seconds();
        enter_block(time, seconds);
        if (!simulation.held.empty())
            lead_held(time, seconds, static_cast<double>(begin) / schedule.steps(),
                      static_cast<double>(end) / schedule.steps());
        StepPlace place{.index = 0,
                        .steps = end - begin,
                        .detects_wisps = schedule.detects_wisps(b),
                        .counts_intersections = b == 0};
        for (; place.index < place.steps; ++place.index)
            step(simulation, place, step_time(begin + place.index));
    }
    simulation.held.radii.clear(); // they have arrived
    root_change_.from.clear();
    ++frame.index;
    frame.time = end_of_frame;
    publish();
    check_finite();
}

void World::Data::publish() {
    const Groom& groom = simulation.groom;
    const State& state = simulation.state;
    const std::uint32_t k_count = groom.envelope_points;
    frame.origin = simulation.origin;
    head_ = cast.head(frame.time);
    frame.first_axis.resize(groom.wisp_count());
    frame.position.resize(groom.section_count());
    frame.velocity.resize(groom.section_count());
    frame.radius.resize(groom.section_count() * k_count);
    frame.radius_rate.resize(groom.section_count() * k_count);
    for (std::size_t p = 0; p < simulation.layout.packets().size(); ++p)
        for (std::uint32_t lane = 0; lane < kLanes; ++lane)
            if (const std::uint32_t w = simulation.layout.packets()[p].wisp[lane];
                w != Layout::kNoWisp)
                frame.first_axis[w] =
                    normalized(simulation.root_axis.vec({static_cast<std::uint32_t>(p), lane}));
    for (std::uint32_t section = 0; section < groom.section_count(); ++section) {
        const Slot slot = simulation.layout.slot(section);
        frame.position[section] = state.position.vec(slot);
        frame.velocity[section] = state.velocity.vec(slot);
        for (std::uint32_t k = 0; k < k_count; ++k) {
            frame.radius[section * k_count + k] = state.radius.at(slot, k);
            frame.radius_rate[section * k_count + k] = state.radius_rate.at(slot, k);
        }
    }
}

void World::Data::check_finite() const {
    const std::uint32_t k_count = simulation.groom.envelope_points;
    for (std::uint32_t section = 0; section < simulation.groom.section_count(); ++section) {
        const Vec3 &x = frame.position[section], &v = frame.velocity[section];
        bool finite = std::isfinite(x.x + x.y + x.z + v.x + v.y + v.z);
        for (std::uint32_t k = 0; k < k_count; ++k)
            finite = finite && std::isfinite(frame.radius[section * k_count + k] +
                                             frame.radius_rate[section * k_count + k]);
        if (!finite)
            throw SimulationError("wisp " + std::to_string(simulation.layout.wisp_of(section)) +
                                  " is not finite at time " + std::to_string(frame.time) +
                                  " s; the motion is too fast for these springs: raise "
                                  "schedule.integration_rate");
    }
}

} // namespace mane
