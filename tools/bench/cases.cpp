#include "bench/cases.h"

#include "base/instruction_set.h"
#include "mane/error.h"
#include "mane/fields.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>
#include <thread>

namespace mane::bench {
namespace {

unsigned thread_count(const tool::BenchOptions& options) {
    return options.threads ? options.threads : std::max(1u, std::thread::hardware_concurrency());
}

/// The paper's styles at our three presets of rates, on one thread.
void add_styles(const tool::BenchOptions& options, std::vector<Case>& cases) {
    for (const char* style : {"short", "medium", "long"})
        for (const char* rates : {"paper", "default", "fine"})
            cases.push_back({.name = fmt::format("styles/{}/{}", style, rates),
                             .scene = fmt::format("{}/scenes/{}.toml", options.project, style),
                             .rates = rates});
}

std::string series_scene(const tool::BenchOptions& options, const std::string& name) {
    return options.project + "/bench/scenes/" + name + ".toml";
}

/// Heads of more and more wisps, shaken, on one thread and on all.
void add_series(const tool::BenchOptions& options, std::vector<Case>& cases) {
    const std::set<unsigned> counts{1, thread_count(options)};
    for (const char* width : {"wide", "slender"})
        for (const char* wisps : {"100", "1000", "10000"})
            for (const unsigned threads : counts)
                cases.push_back({.name = fmt::format("series/{}-{}/{}", width, wisps, threads),
                                 .scene = series_scene(options, fmt::format("{}-{}", width, wisps)),
                                 .threads = threads});
}

/// The same run by every instruction set, and by programs that were built in other ways.
void add_core(const tool::BenchOptions& options, std::vector<Case>& cases) {
    Case c{.scene = series_scene(options, "wide-1000")};
    for (const std::string& set : instruction_sets()) {
        c.name = "core/" + set;
        c.instruction_set = set;
        cases.push_back(c);
    }
    c.instruction_set.clear();
    for (const auto& [name, program] :
         {std::pair{"core/plain", options.plain_core}, {"core/twin", options.twin}})
        if (!program.empty()) {
            c.name = name;
            c.program = program;
            cases.push_back(c);
        }
}

/// Skeleton and envelope alone, by every instruction set and by a program without any.
void add_kernels(const tool::BenchOptions& options, std::vector<Case>& cases) {
    for (const auto& [name, scene] :
         {std::pair<std::string, std::string>{"long", options.project + "/scenes/long.toml"},
          {"wide-1000", series_scene(options, "wide-1000")}}) {
        if (!options.kernel.empty())
            for (const std::string& set : instruction_sets())
                cases.push_back({.name = fmt::format("kernel/{}/{}", name, set),
                                 .scene = scene,
                                 .instruction_set = set,
                                 .program = options.kernel});
        if (!options.plain_kernel.empty())
            cases.push_back({.name = fmt::format("kernel/{}/plain", name),
                             .scene = scene,
                             .program = options.plain_kernel});
    }
}

bool begins(const std::string& name, const Case& c) {
    return c.name == name || c.name.starts_with(name + "/") || c.name.starts_with(name + "-");
}

/// All that `--only` understands: every beginning of every name.
std::vector<std::string> beginnings(const std::vector<Case>& cases) {
    std::set<std::string> all;
    for (const Case& c : cases)
        for (std::size_t end = 0; end != std::string::npos;) {
            end = c.name.find_first_of("/-", end + 1);
            all.insert(c.name.substr(0, end));
        }
    return {all.begin(), all.end()};
}

[[noreturn]] void fail(const std::string& name, const std::vector<Case>& cases) {
    const std::string nearest = nearest_name(name, beginnings(cases));
    if (!nearest.empty())
        throw InputError("--only: no case \"" + name + "\" (did you mean " + nearest + "?)");
    std::string groups;
    for (const Case& c : cases)
        if (!groups.ends_with(c.group()))
            groups += (groups.empty() ? "" : ", ") + c.group();
    throw InputError("--only: no case \"" + name + "\" (known: " + groups +
                     "; all with `mane bench --list`)");
}

/// Straight, and with waves and curls.
void add_strands(const tool::BenchOptions& options, std::vector<Case>& cases) {
    for (const auto& [name, kind] :
         {std::pair("strands/plain", Kind::strands), {"strands/waves-curls", Kind::moving_strands}})
        for (const unsigned threads : {1u, thread_count(options)})
            cases.push_back({.name = fmt::format("{}/{}", name, threads),
                             .kind = kind,
                             .scene = options.project + "/scenes/long.toml",
                             .threads = threads});
}

} // namespace

std::vector<Case> all_cases(const tool::BenchOptions& options) {
    std::vector<Case> cases;
    const unsigned all = thread_count(options);
    cases.push_back({.name = "machine", .kind = Kind::machine, .threads = all});
    add_styles(options, cases);
    add_series(options, cases);
    add_core(options, cases);
    add_kernels(options, cases);
    add_strands(options, cases);
    cases.push_back(
        {.name = "cache", .kind = Kind::cache, .scene = series_scene(options, "wide-1000")});
    for (Case& c : cases) {
        c.most_frames = options.frames.value_or(c.most_frames);
        c.most_preroll = options.preroll.value_or(c.most_preroll);
    }
    return cases;
}

std::vector<Case> selected(const std::vector<Case>& cases, const std::vector<std::string>& names) {
    if (names.empty())
        return cases;
    for (const std::string& name : names)
        if (std::ranges::none_of(cases, [&](const Case& c) { return begins(name, c); }))
            fail(name, cases);
    std::vector<Case> chosen;
    for (const Case& c : cases)
        if (std::ranges::any_of(names, [&](const std::string& n) { return begins(n, c); }))
            chosen.push_back(c);
    return chosen;
}

Json to_json(const Case& c) {
    return {{"name", c.name},
            {"kind", static_cast<int>(c.kind)},
            {"scene", c.scene},
            {"rates", c.rates},
            {"threads", c.threads},
            {"instruction_set", c.instruction_set},
            {"judge", c.judge},
            {"most_frames", c.most_frames},
            {"most_preroll", c.most_preroll}};
}

Case from_json(const Json& json) {
    return {.name = json["name"],
            .kind = static_cast<Kind>(json["kind"].get<int>()),
            .scene = json["scene"],
            .rates = json["rates"],
            .instruction_set = json["instruction_set"],
            .threads = json["threads"],
            .most_frames = json["most_frames"],
            .most_preroll = json["most_preroll"],
            .judge = json["judge"]};
}

} // namespace mane::bench
