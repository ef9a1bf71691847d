// The twin as a case of `mane bench --twin`: how long its steps take on the contacts that the core
// finds.
//   bench_twin bench-one '{"scene": "a.toml", "rates": "", "most_frames": 3, "most_preroll": 3}'

#include "case_program.h"
#include "mane/scene.h"
#include "mane/setup.h"
#include "step/twin_world.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace mane;
using Json = nlohmann::ordered_json;

Json measure(const Json& c) {
    SceneDesc scene = read_scene(c["scene"].get<std::string>());
    if (const std::string rates = c["rates"]; !rates.empty())
        apply_rates(scene, rates);
    const ScheduleDesc& schedule = scene.simulation.schedule;
    const std::uint32_t frames = std::min<std::uint32_t>(schedule.frames, c["most_frames"]),
                        before =
                            std::min<std::uint32_t>(static_cast<std::uint32_t>(std::ceil(
                                                        schedule.preroll * schedule.frame_rate)),
                                                    c["most_preroll"]);
    RunSetup setup = prepare(scene);
    TwinWorld twin(scene.simulation, setup.groom, setup.bodies);
    for (std::uint32_t i = 0; i < before; ++i)
        twin.advance();
    const double start = twin.step_seconds();
    for (std::uint32_t i = 0; i < frames; ++i)
        twin.advance();
    return {{"scene", c["scene"]},
            {"rates", c["rates"]},
            {"threads", 1},
            {"instruction_set", "twin"},
            {"wisps", setup.groom.wisp_count()},
            {"frames", frames},
            {"step_ms", 1e3 * (twin.step_seconds() - start) / frames}};
}

} // namespace

int main(int argc, char** argv) {
    return mane::run_case(argc, argv, measure);
}
