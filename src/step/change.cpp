#include "groom/stability.h"
#include "step/check_desc.h"
#include "step/check_groom.h"
#include "step/world_data.h"

#include <optional>

namespace mane {

void World::Data::change(const SimulationDesc& desc, const Groom* groom) {
    Simulation& s = simulation;
    check_fixed(s.desc, desc);
    check_desc(desc);
    if (groom) {
        check_groom(*groom, cast.body(0).mesh);
        check_same_topology(s.groom, *groom);
    }
    const Schedule schedule(desc.schedule);
    const bool other_steps = schedule.steps() != s.schedule.steps() ||
                             schedule.step_seconds() != s.schedule.step_seconds();
    if (groom || other_steps || desc.air.drag != s.desc.air.drag)
        require_stable_step(groom ? *groom : s.groom, double{desc.air.drag},
                            schedule.step_seconds());
    Air air(desc.air);
    Rows wind = air.is_uniform() || s.wind.components() > 0 ? Rows() : Rows(s.layout.rows(), 3);
    std::optional<Groom> other_groom;
    RestRows rest;
    if (groom) {
        other_groom = *groom;
        rest = RestRows(*groom, s.layout);
        s.held.radii.reserve(2 * groom->wisp_count() * groom->envelope_points);
    }

    // Nothing throws from here on.
    if (desc.wisps.mode == WispContactMode::off)
        s.wisp_detection.forget();
    s.wisp_detection.change(desc.wisps);
    s.wisp_response.change(desc.wisps);
    s.air = std::move(air);
    if (wind.components() > 0)
        s.wind = std::move(wind);
    s.desc = desc;
    if (other_groom)
        take_groom(std::move(*other_groom), std::move(rest));
    if (other_steps) {
        epoch_ = {frame.time, frame.index};
        s.schedule = schedule;
    }
    if (other_steps && frame.index == 0) { // as in a world made with them
        place_roots(frame.time);
        publish();
    }
}

void World::Data::take_groom(Groom&& groom, RestRows&& rest) {
    Simulation& s = simulation;
    s.groom = std::move(groom);
    s.rest = std::move(rest);
    for (const Held::Point& point : s.held.points)
        s.rest.hold(point.slot);
    s.wisp_response.forget_masses();
    s.contact_geometry.change_design(s.groom);
    s.held.radii.clear();
    const std::uint32_t k_count = s.groom.envelope_points;
    for (std::size_t w = 0; w < s.groom.wisp_count(); ++w)
        for (std::uint32_t section = s.groom.first_section[w];
             section < s.groom.first_section[w] + 2; ++section)
            for (std::uint32_t k = 0; k < k_count; ++k) {
                const Slot slot = s.layout.slot(section);
                const float now = s.state.radius.at(slot, k),
                            next = s.groom.radius[section * k_count + k];
                if (now != next)
                    s.held.radii.push_back({.slot = slot, .k = k, .from = now, .to = next});
            }
}

} // namespace mane
