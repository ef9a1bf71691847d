#include "step/simulation.h"

namespace mane {

Simulation::Simulation(const SimulationDesc& d, const Groom& g, const RunOptions& options)
    : desc(d), groom(g), layout(groom), rest(groom, layout),
      lines(half_lines(groom.envelope_points)), schedule(d.schedule), air(d.air),
      kernels(kernels_for(options.instruction_set)), state(layout.rows(), groom.envelope_points),
      root_axis(layout.packets().size(), 3), roots(layout.packets().size()),
      contact_geometry(options.instruction_set),
      wisp_detection(d.wisps, {}, options.instruction_set),
      wisp_response(d.wisps, options.instruction_set),
      character_contacts({}, options.instruction_set), frames(layout.rows()),
      scratch(force_scratch(layout)), threads(options.threads), on_stage(options.on_stage) {
    if (!air.is_uniform())
        wind = Rows(layout.rows(), 3);
}

KernelData Simulation::kernel_data() {
    return {.layout = layout,
            .rest = rest,
            .roots = roots,
            .half_lines = lines,
            .state = state,
            .frames = frames,
            .scratch = scratch,
            .root_axis = root_axis,
            .wind = air.is_uniform() ? nullptr : &wind,
            .uniform_wind = air.mean(),
            .gravity = desc.gravity,
            .drag = desc.air.drag,
            .step = static_cast<float>(schedule.step_seconds())};
}

} // namespace mane
