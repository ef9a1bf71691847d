#include "bench/results.h"
#include "bench/work.h"
#include "mane/world.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>

namespace mane::bench {
namespace {

using Rows = std::vector<const Result*>;

/// A table of text: the first column is the case's name.
struct Column {
    std::string head;
    std::function<std::string(const Json&)> cell;
};

std::string table(const std::string& title, const Rows& rows, const std::vector<Column>& columns) {
    std::string text = "\n" + title + "\n" + fmt::format("{:26}", "");
    const auto width = [](const Column& c) { return std::max<std::size_t>(c.head.size(), 7) + 2; };
    for (const Column& c : columns)
        text += fmt::format("{:>{}}", c.head, width(c));
    for (const Result* row : rows) {
        text += fmt::format("\n{:26}", row->what.name);
        for (const Column& c : columns)
            text += fmt::format("{:>{}}", c.cell(row->medians), width(c));
    }
    return text + "\n";
}

/// Three digits that count.
std::string number(double x) {
    const double size = std::abs(x);
    return fmt::format("{:.{}f}", x,
                       size >= 100 || size == 0 ? 0
                       : size >= 10             ? 1
                       : size >= 1              ? 2
                                                : 3);
}

/// The number at `path`, times `factor`; empty where there is none.
Column value(std::string head, const std::string& path, double factor = 1) {
    const Json::json_pointer pointer(path);
    return {std::move(head), [=](const Json& m) {
                return m.contains(pointer) && m[pointer].is_number()
                           ? number(factor * m[pointer].get<double>())
                           : std::string();
            }};
}

const Json* medians_of(const std::vector<Result>& results, const std::string& name) {
    const auto found =
        std::ranges::find(results, name, [](const Result& r) { return r.what.name; });
    return found == results.end() ? nullptr : &found->medians;
}

Rows group_of(const std::vector<Result>& results, const std::string& group) {
    Rows rows;
    for (const Result& r : results)
        if (r.what.group() == group)
            rows.push_back(&r);
    return rows;
}

std::string times(const std::string& title, const Rows& rows) {
    std::vector<Column> columns{value("× real time", "/times_real_time"),
                                value("frame", "/frame_ms")};
    for (std::size_t s = 0; s < static_cast<std::size_t>(Stage::count); ++s) {
        const std::string stage = stage_name(static_cast<Stage>(s));
        columns.push_back(value(stage, "/stage_ms/" + stage));
    }
    columns.push_back(value("other", "/stage_ms/other"));
    columns.push_back(value("wall s", "/wall_seconds"));
    columns.push_back(value("CPU s", "/cpu_seconds"));
    columns.push_back(value("loading s", "/loading_seconds"));
    columns.push_back(value("peak MB", "/peak_mb"));
    return table(title + ": ms per frame", rows, columns);
}

std::string quality(const Rows& rows) {
    const Column hash{"      state hash", [](const Json& m) {
                          return m.contains("state_hash") ? m["state_hash"].get<std::string>()
                                                          : std::string();
                      }};
    return table("what came of it", rows,
                 {value("wisp contacts: sliding", "/contacts/friction"),
                  value("colliding", "/contacts/collision"),
                  value("on bodies", "/contacts/sliding"),
                  value("intersections", "/contacts/intersections_per_segment"),
                  value("points inside", "/quality/skeleton_inside"),
                  value("deepest mm", "/quality/skeleton_depth", 1e3),
                  value("strands deep %", "/quality/strands_deep", 100),
                  value("stretch %", "/quality/stretch", 100),
                  value("area %", "/quality/area_mean", 100), hash});
}

/// The machine's peak at `path` for a run on one thread or on all; 0: not measured.
double peak(const Json* machine, const Json& run, const std::string& group,
            const std::string& name) {
    if (!machine)
        return 0;
    const std::string all = run["threads"].get<unsigned>() > 1 ? "_all_threads" : "";
    const Json::json_pointer pointer("/" + group + all + "/" + name);
    return machine->contains(pointer) ? (*machine)[pointer].get<double>() : 0;
}

/// A stage's operations as a share of the peak of separate multiply and add.
Column of_operations(const Json* machine, const std::string& cost, const StageWork& work) {
    return {"% of flops", [=](const Json& m) {
                const double most = peak(machine, m, "gflops",
                                         m["instruction_set"].get<std::string>() + "/multiply_add");
                const double time = m["cost"][cost].get<double>();
                return most > 0 && time > 0 ? number(100 * work.operations / time / most)
                                            : std::string();
            }};
}
/// A stage's bytes as a share of what the machine can move: from the second level of the cache
/// where all rows fit into it, else from memory.
Column of_bandwidth(const Json* machine, const std::string& cost, const StageWork& work) {
    constexpr double kCacheBytes = 1e6;
    return {
        "% of bandwidth", [=](const Json& m) {
            const bool near = m["packet_rows"].get<double>() * work.bytes < kCacheBytes;
            const double most = peak(machine, m, "triad_gb_per_second", near ? "cache" : "memory");
            const double time = m["cost"][cost].get<double>();
            return most > 0 && time > 0 ? number(100 * work.bytes / time / most) : std::string();
        }};
}

std::string costs(const Rows& rows, const Json* machine) {
    Rows known;
    for (const Result* row : rows)
        if (row->medians.contains("cost"))
            known.push_back(row);
    return table(
        "each stage against what binds it: ns per packet row, segment, section and contact", known,
        {value("forces", "/cost/forces_per_packet"),
         of_operations(machine, "forces_per_packet", kForces),
         of_bandwidth(machine, "forces_per_packet", kForces),
         value("positions", "/cost/positions_per_packet"),
         of_operations(machine, "positions_per_packet", kPositions),
         of_bandwidth(machine, "positions_per_packet", kPositions),
         value("wisp detection", "/cost/wisp_detection_per_segment"),
         value("character detection", "/cost/character_detection_per_section"),
         value("answer", "/cost/answer_per_contact")});
}

std::string simulations(const std::string& title, const Rows& rows, const Json* machine) {
    return times(title, rows) + quality(rows) + costs(rows, machine);
}

/// Times as multiples of the first row's.
Column multiple(std::string head, const std::string& path, const Json& first) {
    const Json::json_pointer pointer(path);
    const double one = first.contains(pointer) ? first[pointer].get<double>() : 0;
    return {std::move(head), [=](const Json& m) {
                return one > 0 && m.contains(pointer) ? number(m[pointer].get<double>() / one)
                                                      : std::string();
            }};
}

std::string ratios(const Rows& rows) {
    const Json& first = rows.front()->medians;
    return table("times the first one's time", rows,
                 {multiple("forces", "/stage_ms/forces", first),
                  multiple("positions", "/stage_ms/positions", first),
                  multiple("step without detection", "/step_ms", first),
                  multiple("frame", "/frame_ms", first)});
}

/// Per row of sixteen cross-sections.
std::string kernels(const Rows& rows, const Json* machine) {
    return table("skeleton and envelope alone: ns per packet row and step", rows,
                 {value("packet rows", "/packet_rows"), value("forces", "/cost/forces_per_packet"),
                  of_operations(machine, "forces_per_packet", kForces),
                  of_bandwidth(machine, "forces_per_packet", kForces),
                  value("positions", "/cost/positions_per_packet"),
                  value("together", "/cost/kernel_per_packet")});
}

std::string machine_table(const Json& m) {
    std::string text = "\nmachine: billions of operations a second, one thread (all " +
                       m["threads"].dump() + ")\n";
    for (const auto& [set, one] : m["gflops"].items()) {
        text += fmt::format("{:26}", set);
        for (const auto& [what, figure] : one.items())
            text += fmt::format("  {} {} ({})", what, number(figure.get<double>()),
                                number(m["gflops_all_threads"][set][what].get<double>()));
        text += "\n";
    }
    text += fmt::format("{:26}", "triad, GB/s");
    for (const auto& [what, figure] : m["triad_gb_per_second"].items())
        text += fmt::format("  {} {} ({})", what, number(figure.get<double>()),
                            number(m["triad_gb_per_second_all_threads"][what].get<double>()));
    return text + "\n";
}

std::string strands_table(const Rows& rows) {
    return table("strands: millions of 32 vertices a second", rows,
                 {value("millions", "/million_strands_of_32_per_second"),
                  value("ns per vertex", "/ns_per_vertex"),
                  value("% of a plain fill", "/share_of_plain_fill", 100),
                  value("which does GB/s", "/plain_fill_gb_per_second"),
                  value("recipes ms", "/recipes_ms"), value("pose ms", "/pose_ms"),
                  value("peak MB", "/peak_mb")});
}

std::string cache_table(const Rows& rows) {
    return table("cache: MB of unpacked frames a second", rows,
                 {value("write", "/write_mb_per_second"), value("read", "/read_mb_per_second"),
                  value("MB per frame", "/mb_per_frame"),
                  value("packed to %", "/packed_share", 100), value("peak MB", "/peak_mb")});
}

} // namespace

std::string to_tables(const Circumstances& where, const std::vector<Result>& results) {
    const Json* machine = medians_of(results, "machine");
    std::string text = fmt::format("mane {}, {}, {}, {} hardware threads, {}; medians of {} runs\n",
                                   where.version, where.date, where.processor,
                                   where.hardware_threads, where.instruction_set, where.runs);
    if (machine)
        text += machine_table(*machine);
    for (const auto& [group, title] :
         {std::pair{"styles", "styles, one thread"}, {"series", "series"}, {"core", "core"}})
        if (const Rows rows = group_of(results, group); !rows.empty()) {
            text += simulations(title, rows, machine);
            if (std::string_view(group) == "core")
                text += ratios(rows);
        }
    if (const Rows rows = group_of(results, "kernel"); !rows.empty())
        text += kernels(rows, machine);
    if (const Rows rows = group_of(results, "strands"); !rows.empty())
        text += strands_table(rows);
    if (const Rows rows = group_of(results, "cache"); !rows.empty())
        text += cache_table(rows);
    return text;
}

} // namespace mane::bench
