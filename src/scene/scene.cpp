#include "mane/scene.h"

#include "mane/error.h"

#include <algorithm>
#include <vector>

namespace mane {
namespace {

struct Rates {
    std::string_view name;
    float integration, character, wisp; // [Hz]
};
constexpr Rates kRates[] = {{"default", 1000, 120, 120},
                            {"paper", 1000, 120, 24},
                            {"fine", 1000, 1000, 1000},
                            {"paper-literal", 1000, 120, 24}};

void set_by_key(SceneDesc& scene, const std::string& key, const Value& value) {
    const std::size_t dot = key.find('.');
    find_field(key.substr(0, dot), key.substr(dot + 1))->set(scene, value);
}

} // namespace

SceneDesc scene_of_wisp(const SceneDesc& scene, std::uint32_t wisp) {
    SceneDesc own = scene;
    for (const WispOverride& o : scene.overrides)
        if (std::find(o.wisps.begin(), o.wisps.end(), wisp) != o.wisps.end())
            for (const auto& [key, value] : o.settings)
                set_by_key(own, key, value);
    return own;
}

void apply_rates(SceneDesc& scene, std::string_view preset) {
    const auto rates = std::find_if(std::begin(kRates), std::end(kRates),
                                    [&](const Rates& r) { return r.name == preset; });
    if (rates == std::end(kRates)) {
        std::string names;
        for (const Rates& r : kRates)
            names += (names.empty() ? "" : ", ") + std::string(r.name);
        throw InputError("rates \"" + std::string(preset) + "\": expected one of " + names);
    }
    const bool literal = preset == "paper-literal";
    ScheduleDesc& schedule = scene.simulation.schedule;
    schedule.integration_rate = rates->integration;
    schedule.character_rate = rates->character;
    schedule.wisp_rate = rates->wisp;
    schedule.hold_contacts = !literal;
    if (literal)
        scene.simulation.wisps.literal = true;
}

void check_scene(const SceneDesc& scene, const std::string& where) {
    const auto expect = [&](bool holds, const char* low, const char* high) {
        if (holds)
            return;
        const auto shown = [&](const std::string& key) {
            const std::size_t dot = key.find('.');
            return key + " = " +
                   to_toml(find_field(key.substr(0, dot), key.substr(dot + 1))->get(scene));
        };
        throw InputError(where + ": found " + shown(low) + " and " + shown(high) +
                         ", expected the first not above the second");
    };
    const SimulationDesc& s = scene.simulation;
    expect(s.character.push_out <= s.character.threshold, "character.push_out",
           "character.threshold");
    expect(s.wisps.fade_angle <= s.wisps.parallel_angle, "wisps.fade_angle",
           "wisps.parallel_angle");
    expect(s.schedule.frame_rate <= s.schedule.integration_rate, "schedule.frame_rate",
           "schedule.integration_rate");
    expect(s.schedule.character_rate <= s.schedule.integration_rate, "schedule.character_rate",
           "schedule.integration_rate");
    expect(scene.motion.drive.first <= scene.motion.drive.last, "motion.first", "motion.last");
    expect(s.schedule.wisp_rate <= s.schedule.integration_rate, "schedule.wisp_rate",
           "schedule.integration_rate");
}

} // namespace mane
