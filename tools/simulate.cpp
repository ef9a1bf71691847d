#include "commands.h"

#include "interrupt.h"
#include "mane/cache.h"
#include "mane/error.h"
#include "mane/scene.h"
#include "mane/setup.h"
#include "mane/world.h"
#include "poses.h"
#include "progress.h"
#include "report.h"
#include "trace.h"

#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <thread>

namespace mane::tool {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

SceneDesc load_scene(const SimulateOptions& options) {
    SceneDesc scene = read_scene(options.scene);
    if (!options.rates.empty())
        apply_rates(scene, options.rates);
    for (const std::string& setting : options.settings)
        apply_setting(scene, setting);
    if (options.frames)
        apply_setting(scene, "schedule.frames=" + std::to_string(*options.frames));
    return scene;
}

/// What one frame added to the statistics: the profile and the contacts of `--record`.
std::vector<Column> difference(const Statistics& before, const Statistics& now) {
    const auto count = [](const char* name, std::uint64_t a, std::uint64_t b) {
        return Column{name, "1", std::vector<std::uint32_t>{static_cast<std::uint32_t>(b - a)}};
    };
    std::vector<Column> table;
    for (std::size_t s = 0; s < static_cast<std::size_t>(Stage::count); ++s)
        table.push_back({stage_name(static_cast<Stage>(s)), "s",
                         std::vector<double>{now.stage_seconds[s] - before.stage_seconds[s]}});
    table.push_back(count("steps", before.steps, now.steps));
    table.push_back(count("wisp_detections", before.wisp_detections, now.wisp_detections));
    table.push_back(
        count("character_detections", before.character_detections, now.character_detections));
    table.push_back(
        count("intersection_counts", before.intersection_counts, now.intersection_counts));
    table.push_back(count("intersections", before.intersections, now.intersections));
    table.push_back(count("friction_contacts", before.friction_contacts, now.friction_contacts));
    table.push_back(count("collision_contacts", before.collision_contacts, now.collision_contacts));
    table.push_back(count("sliding_contacts", before.sliding_contacts, now.sliding_contacts));
    table.push_back(
        count("penetration_reactions", before.penetration_reactions, now.penetration_reactions));
    return table;
}

/// A table of records, one per row, a column from each.
template <typename R> class Columns {
  public:
    explicit Columns(const std::vector<R>& records) : records_(records) {}
    template <typename Of> Columns& whole(const char* name, Of&& of) {
        return add<std::uint32_t>(name, "1", of);
    }
    template <typename Of> Columns& real(const char* name, const char* unit, Of&& of) {
        return add<float>(name, unit, of);
    }
    template <typename Of> Columns& vector(const std::string& name, const char* unit, Of&& of) {
        add<float>(name + "_x", unit, [&](const R& r) { return of(r).x; });
        add<float>(name + "_y", unit, [&](const R& r) { return of(r).y; });
        return add<float>(name + "_z", unit, [&](const R& r) { return of(r).z; });
    }
    std::vector<Column> table() { return std::move(table_); }

  private:
    template <typename T, typename Of>
    Columns& add(const std::string& name, const char* unit, Of&& of) {
        std::vector<T> column;
        column.reserve(records_.size());
        for (const R& record : records_)
            column.push_back(static_cast<T>(of(record)));
        table_.push_back({name, unit, std::move(column)});
        return *this;
    }
    const std::vector<R>& records_;
    std::vector<Column> table_;
};

std::vector<Column> contact_table(const std::vector<Contact>& contacts) {
    return Columns(contacts)
        .whole("kind", [](const Contact& c) { return c.kind; })
        .whole("section", [](const Contact& c) { return c.section; })
        .whole("point", [](const Contact& c) { return c.point; })
        .real("along", "1", [](const Contact& c) { return c.along; })
        .whole("other", [](const Contact& c) { return c.other; })
        .real("other_along", "1", [](const Contact& c) { return c.other_along; })
        .whole("body", [](const Contact& c) { return c.body; })
        .vector("impulse", "N s", [](const Contact& c) { return c.impulse; })
        .table();
}

std::vector<Column> reaction_table(const std::vector<Reaction>& reactions) {
    return Columns(reactions)
        .whole("section", [](const Reaction& r) { return r.section; })
        .whole("point", [](const Reaction& r) { return r.point; })
        .whole("body", [](const Reaction& r) { return r.body; })
        .whole("triangle", [](const Reaction& r) { return r.triangle; })
        .vector("shift", "m", [](const Reaction& r) { return r.shift; })
        .table();
}

/// One run: the preroll, which is not stored, and the frames of the scene.
class Run {
  public:
    Run(const SimulateOptions& options, const SceneDesc& scene, const RunSetup& setup, Trace* trace)
        : options_(options), schedule_(scene.simulation.schedule), setup_(setup), trace_(trace),
          preroll_(static_cast<std::uint32_t>(std::ceil(schedule_.preroll * schedule_.frame_rate))),
          world_(scene.simulation, setup.groom, setup.bodies,
                 -static_cast<double>(preroll_) / schedule_.frame_rate,
                 {options.threads, options.instruction_set, stage_observer(trace)}) {}

    /// Simulates until the end or a signal.
    void simulate(CacheWriter& cache, const Interrupt& interrupt) {
        const Clock::time_point start = Clock::now();
        const std::clock_t cpu_start = std::clock();
        Progress progress(preroll_ + schedule_.frames);
        for (std::uint32_t i = 0; i < preroll_ + schedule_.frames && !interrupt.signal(); ++i) {
            if (i > 0)
                advance(std::int64_t{i} - preroll_);
            if (i >= preroll_)
                store(cache, i - preroll_);
            progress.show(i + 1);
        }
        wall_seconds_ = seconds_since(start);
        cpu_seconds_ = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    }

    Report report(const CacheWriter& cache, bool interrupted) const {
        Report r;
        r.scene = options_.scene;
        r.frames = static_cast<std::uint32_t>(cache.frame_count());
        r.simulated_seconds = world_.frame().index / static_cast<double>(schedule_.frame_rate);
        r.wall_seconds = wall_seconds_;
        r.cpu_seconds = cpu_seconds_;
        r.writing_seconds = writing_seconds_;
        r.statistics = world_.statistics();
        r.wisps = setup_.groom.wisp_count();
        r.segments = setup_.groom.section_count() - 2 * setup_.groom.wisp_count();
        r.state_hash = world_.state_hash();
        r.threads = options_.threads > 0 ? options_.threads : std::thread::hardware_concurrency();
        r.instruction_set = world_.instruction_set();
        r.interrupted = interrupted;
        return r;
    }

  private:
    static std::function<void(const StageSpan&)> stage_observer(Trace* trace) {
        if (!trace)
            return nullptr;
        return [trace](const StageSpan& span) { trace->add(span); };
    }

    void advance(std::int64_t frame) {
        before_ = world_.statistics();
        const Clock::time_point start = Clock::now();
        world_.advance();
        if (trace_)
            trace_->add_frame(frame, start, Clock::now());
    }

    void store(CacheWriter& cache, std::uint32_t index) {
        const Clock::time_point start = Clock::now();
        Frame frame = world_.frame();
        frame.index = index;
        cache.add(frame, poses_at(setup_.bodies, frame.time));
        if (options_.record) {
            cache.add_table("PROF", index, difference(before_, world_.statistics()));
            cache.add_table("CONT", index, contact_table(world_.contacts()));
            cache.add_table("REAC", index, reaction_table(world_.reactions()));
        }
        writing_seconds_ += seconds_since(start);
        if (trace_)
            trace_->add_writing(start, Clock::now());
    }

    const SimulateOptions& options_;
    ScheduleDesc schedule_;
    const RunSetup& setup_;
    Trace* trace_;          ///< null: nobody wants to see the stages
    std::uint32_t preroll_; ///< [1] frames before the first stored one
    World world_;
    Statistics before_;
    double wall_seconds_ = 0, cpu_seconds_ = 0, writing_seconds_ = 0;
};

void write_statistics(const std::string& file, const std::string& json) {
    std::ofstream out(file, std::ios::binary);
    out << json;
    out.close();
    if (!out)
        throw InputError(file + ": cannot be written");
}

} // namespace

int simulate(const SimulateOptions& options) {
    const SceneDesc scene = load_scene(options);
    const RunSetup setup = prepare(scene);
    for (const std::string& warning : setup.warnings)
        fmt::print(stderr, "mane: warning: {}\n", warning);
    std::optional<Trace> trace;
    if (!options.trace.empty())
        trace.emplace(options.trace);
    Run run(options, scene, setup, trace ? &*trace : nullptr);
    CacheWriter cache(options.output, setup);
    const Interrupt interrupt;
    try {
        run.simulate(cache, interrupt);
    } catch (const SimulationError& error) {
        if (cache.frame_count() == 0)
            throw;
        throw SimulationError(fmt::format("{}; the {} frames before are in {}", error.what(),
                                          cache.frame_count(), cache.path().string()));
    }
    const Report report = run.report(cache, interrupt.signal() != 0);
    const std::string json = to_json(report);
    cache.finish(json);
    if (!options.statistics.empty())
        write_statistics(options.statistics, json);
    if (trace)
        trace->finish();
    if (interrupt.signal()) {
        fmt::print(stderr, "mane: interrupted; {} holds the {} frames so far\n", options.output,
                   report.frames);
        return 128 + interrupt.signal();
    }
    fmt::print("{}", to_table(report));
    return 0;
}

} // namespace mane::tool
