#include "groom/stability.h"
#include "step/check_desc.h"
#include "step/world_data.h"

namespace mane {

void World::Data::change(const SimulationDesc& desc) {
    Simulation& s = simulation;
    check_fixed(s.desc, desc);
    check_desc(desc);
    const Schedule schedule(desc.schedule);
    const bool other_steps = schedule.steps() != s.schedule.steps() ||
                             schedule.step_seconds() != s.schedule.step_seconds();
    if (other_steps || desc.air.drag != s.desc.air.drag)
        require_stable_step(s.groom, double{desc.air.drag}, schedule.step_seconds());
    Air air(desc.air);
    Rows wind =
        air.is_uniform() || s.wind.components() > 0 ? std::move(s.wind) : Rows(s.layout.rows(), 3);

    // Nothing throws from here on.
    if (desc.wisps.mode == WispContactMode::off)
        s.wisp_detection.forget();
    s.wisp_detection.change(desc.wisps);
    s.wisp_response.change(desc.wisps);
    s.air = std::move(air);
    s.wind = std::move(wind);
    s.desc = desc;
    if (other_steps) {
        epoch_ = {frame.time, frame.index};
        s.schedule = schedule;
    }
    if (other_steps && frame.index == 0) { // as in a world made with them
        place_roots(frame.time);
        publish();
    }
}

} // namespace mane
