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
    const bool other_steps = !schedule.same_steps(s.schedule);
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
    s.wisp_detection.change(desc.wisps);
    s.wisp_response.change(desc.wisps);
    s.air = std::move(air);
    if (wind.components() > 0)
        s.wind = std::move(wind);
    s.desc = desc;
    if (other_groom)
        take_groom(std::move(*other_groom), std::move(rest));
    s.schedule = schedule;
    if (other_steps && frame.index == 0) { // as in a world made with them
        place_roots(frame.time);
        publish();
    }
}

void World::Data::take_groom(Groom&& groom, RestRows&& rest) {
    Simulation& s = simulation;
    if (root_change_.from.empty())
        root_change_.from = std::move(s.groom.roots);
    if (root_change_.from == groom.roots)
        root_change_.from.clear();
    s.groom = std::move(groom);
    s.rest = std::move(rest);
    for (const Held::Point& point : s.held.points)
        s.rest.hold(point.slot);
    s.wisp_response.forget_masses();
    s.contact_geometry.change_design(s.groom);
    lead_radii_on_head();
}

/// No spring moves them.
void World::Data::lead_radii_on_head() {
    Simulation& s = simulation;
    const std::uint32_t k_count = s.groom.envelope_points;
    s.held.radii.clear();
    for (const std::uint32_t first : std::span(s.groom.first_section).first(s.groom.wisp_count()))
        for (std::uint32_t section = first; section < first + 2; ++section)
            for (std::uint32_t k = 0; k < k_count; ++k) {
                const Slot slot = s.layout.slot(section);
                const float now = s.state.radius.at(slot, k),
                            next = s.groom.radius[section * k_count + k];
                if (now != next)
                    s.held.radii.push_back({.slot = slot, .k = k, .from = now, .to = next});
            }
}

} // namespace mane
