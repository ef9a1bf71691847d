#include "report.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace mane::tool {
namespace {

constexpr std::size_t kStages = static_cast<std::size_t>(Stage::count);

double ratio(double a, double b) {
    return b > 0 ? a / b : 0;
}

double stage_seconds(const Report& r, Stage stage) {
    return r.statistics.stage_seconds[static_cast<std::size_t>(stage)];
}

double all_stages(const Report& r) {
    double sum = 0;
    for (const double s : r.statistics.stage_seconds)
        sum += s;
    return sum;
}

double detection_seconds(const Report& r) {
    return stage_seconds(r, Stage::wisp_detection) + stage_seconds(r, Stage::character_detection);
}

double per(std::uint64_t count, std::uint64_t detections) {
    return ratio(static_cast<double>(count), static_cast<double>(detections));
}

std::string hexadecimal(std::uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

} // namespace

double Report::segments_per_wisp() const {
    return ratio(static_cast<double>(segments), static_cast<double>(wisps));
}

double Report::intersections_per_segment() const {
    return ratio(per(statistics.intersections, statistics.intersection_counts),
                 static_cast<double>(segments));
}

double Report::real_time_ratio() const {
    return ratio(simulated_seconds, wall_seconds);
}
double Report::detection_share() const {
    return ratio(detection_seconds(*this), all_stages(*this));
}
double Report::wisp_share_of_detection() const {
    return ratio(stage_seconds(*this, Stage::wisp_detection), detection_seconds(*this));
}

std::string to_json(const Report& r) {
    nlohmann::ordered_json stages = nlohmann::ordered_json::object();
    for (std::size_t s = 0; s < kStages; ++s)
        stages[stage_name(static_cast<Stage>(s))] = r.statistics.stage_seconds[s];
    const Statistics& n = r.statistics;
    const nlohmann::ordered_json all{{"version", MANE_VERSION},
                                     {"scene", r.scene},
                                     {"frames", r.frames},
                                     {"interrupted", r.interrupted},
                                     {"simulated_seconds", r.simulated_seconds},
                                     {"wall_seconds", r.wall_seconds},
                                     {"cpu_seconds", r.cpu_seconds},
                                     {"writing_seconds", r.writing_seconds},
                                     {"real_time_ratio", r.real_time_ratio()},
                                     {"threads", r.threads},
                                     {"instruction_set", r.instruction_set},
                                     {"stages", stages},
                                     {"detection_share", r.detection_share()},
                                     {"wisp_share_of_detection", r.wisp_share_of_detection()},
                                     {"steps", n.steps},
                                     {"wisp_detections", n.wisp_detections},
                                     {"character_detections", n.character_detections},
                                     {"wisps", r.wisps},
                                     {"segments", r.segments},
                                     {"segments_per_wisp", r.segments_per_wisp()},
                                     {"intersections_per_segment", r.intersections_per_segment()},
                                     {"contacts",
                                      {{"friction", n.friction_contacts},
                                       {"collision", n.collision_contacts},
                                       {"sliding", n.sliding_contacts},
                                       {"penetration", n.penetration_reactions}}},
                                     {"state_hash", hexadecimal(r.state_hash)}};
    return all.dump(2) + "\n";
}

std::string to_table(const Report& r) {
    const Statistics& n = r.statistics;
    std::string out = fmt::format("\n{:30}{:>10}   paper: {:>8}{:>9}{:>9}\n", "", "this run",
                                  "short", "medium", "long");
    const auto row = [&](const char* name, const std::string& ours, const char* s, const char* m,
                         const char* l) {
        out += fmt::format("{:30}{:>10}          {:>8}{:>9}{:>9}\n", name, ours, s, m, l);
    };
    row("wisps", std::to_string(r.wisps), "199", "73", "56");
    row("segments per wisp", fmt::format("{:.1f}", r.segments_per_wisp()), "4.0", "9.9", "7.7");
    row("intersections per segment", fmt::format("{:.1f}", r.intersections_per_segment()), "17.5",
        "21.0", "12.8");
    row("frames", std::to_string(r.frames), "264", "264", "264");
    row("time", fmt::format("{:.2f} s", r.wall_seconds), "3.2 h", "2.9 h", "2.9 h");
    row("  of processor", fmt::format("{:.2f} s", r.cpu_seconds), "", "", "");
    row("share of finding contacts", fmt::format("{:.0f} %", 100 * r.detection_share()), "",
        "92–95 %", "");
    row("  of it, between wisps", fmt::format("{:.0f} %", 100 * r.wisp_share_of_detection()), "",
        "64–70 %", "");

    out += "\nseconds\n";
    for (std::size_t s = 0; s < kStages; ++s)
        out +=
            fmt::format("  {:28}{:10.3f}\n", stage_name(static_cast<Stage>(s)), n.stage_seconds[s]);
    out += fmt::format("  {:28}{:10.3f}\n", "writing", r.writing_seconds);
    out += "contacts per detection\n";
    out += fmt::format("  {:28}{:10.1f}\n", "wisps sliding",
                       per(n.friction_contacts, n.wisp_detections));
    out += fmt::format("  {:28}{:10.1f}\n", "wisps colliding",
                       per(n.collision_contacts, n.wisp_detections));
    out += fmt::format("  {:28}{:10.1f}\n", "sliding on the character",
                       per(n.sliding_contacts, n.character_detections));
    out += fmt::format("  {:28}{:10.1f}\n", "moved out of it",
                       per(n.penetration_reactions, n.character_detections));
    out += fmt::format("\n{:.2f} times real time on {} thread{} ({}); state hash {}\n",
                       r.real_time_ratio(), r.threads, r.threads == 1 ? "" : "s", r.instruction_set,
                       hexadecimal(r.state_hash));
    return out;
}

} // namespace mane::tool
