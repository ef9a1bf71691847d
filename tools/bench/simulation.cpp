#include "bench/measure.h"
#include "bench/scratch_file.h"
#include "mane/cache.h"
#include "mane/check.h"
#include "mane/scene.h"
#include "mane/setup.h"
#include "mane/world.h"
#include "poses.h"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace mane::bench {
namespace {

SceneDesc scene_of(const Case& c) {
    SceneDesc scene = read_scene(c.scene);
    if (!c.rates.empty())
        apply_rates(scene, c.rates);
    ScheduleDesc& schedule = scene.simulation.schedule;
    schedule.frames = std::min(schedule.frames, c.most_frames);
    schedule.preroll =
        std::min(schedule.preroll, static_cast<float>(c.most_preroll) / schedule.frame_rate);
    return scene;
}

/// Rows of sixteen cross-sections that the kernels step through: simulated ones, of wisps sorted by
/// their number of sections.
double packet_rows(const Groom& groom) {
    std::vector<std::uint32_t> simulated;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        simulated.push_back(groom.sections(w) - 2);
    std::ranges::sort(simulated, std::greater());
    std::size_t rows = 0;
    for (std::size_t w = 0; w < simulated.size(); w += 16)
        rows += simulated[w];
    return static_cast<double>(rows);
}

double ratio(double a, double b) {
    return b > 0 ? a / b : 0;
}

/// What the measured frames added to the statistics.
Statistics difference(const Statistics& now, const Statistics& before) {
    Statistics d = now;
    for (std::size_t s = 0; s < static_cast<std::size_t>(Stage::count); ++s)
        d.stage_seconds[s] -= before.stage_seconds[s];
    d.steps -= before.steps;
    d.wisp_detections -= before.wisp_detections;
    d.character_detections -= before.character_detections;
    d.intersection_counts -= before.intersection_counts;
    d.intersections -= before.intersections;
    d.friction_contacts -= before.friction_contacts;
    d.collision_contacts -= before.collision_contacts;
    d.sliding_contacts -= before.sliding_contacts;
    d.penetration_reactions -= before.penetration_reactions;
    return d;
}

/// One run: the preroll, which counts for nothing, and the measured frames.
class Run {
  public:
    explicit Run(const Case& c) : case_(c), scene_(bench::scene_of(c)) {
        loading_.go();
        setup_ = prepare(scene_);
        const ScheduleDesc& schedule = scene_.simulation.schedule;
        preroll_ = static_cast<std::uint32_t>(std::ceil(schedule.preroll * schedule.frame_rate));
        world_.emplace(scene_.simulation, setup_.groom, setup_.bodies,
                       -static_cast<double>(preroll_) / schedule.frame_rate,
                       RunOptions{c.threads, c.instruction_set, {}});
        loading_.hold();
    }

    void simulate(CacheWriter* cache) {
        for (std::uint32_t i = 0; i < preroll_; ++i)
            world_->advance();
        const Statistics before = world_->statistics();
        for (std::uint32_t i = 0; i < scene_.simulation.schedule.frames; ++i) {
            watch_.go();
            world_->advance();
            watch_.hold();
            if (cache && i % judged_every() == 0)
                store(*cache, i);
        }
        did_ = difference(world_->statistics(), before);
    }

    const RunSetup& setup() const { return setup_; }

    Json figures() const {
        const double frames = scene_.simulation.schedule.frames;
        const double seconds = frames / double{scene_.simulation.schedule.frame_rate};
        return {{"scene", case_.scene},
                {"rates", case_.rates},
                {"threads", case_.threads},
                {"instruction_set", world_->instruction_set()},
                {"wisps", setup_.groom.wisp_count()},
                {"segments", segments()},
                {"packet_rows", packet_rows(setup_.groom)},
                {"frames", scene_.simulation.schedule.frames},
                {"simulated_seconds", seconds},
                {"loading_seconds", loading_.wall()},
                {"wall_seconds", watch_.wall()},
                {"cpu_seconds", watch_.cpu()},
                {"times_real_time", ratio(seconds, watch_.wall())},
                {"frame_ms", 1e3 * watch_.wall() / frames},
                {"stage_ms", stages(frames)},
                {"step_ms", step_milliseconds(frames)},
                {"cost", costs()},
                {"contacts", contacts()},
                {"peak_mb", peak_megabytes()},
                {"state_hash", fmt::format("{:016x}", world_->state_hash())}};
    }

  private:
    void store(CacheWriter& cache, std::uint32_t index) {
        Frame frame = world_->frame();
        frame.index = index;
        cache.add(frame, tool::poses_at(setup_.bodies, frame.time));
    }

    /// Every so many frames are judged: all of a style's, ten of ten thousand wisps.
    std::uint32_t judged_every() const {
        constexpr double kJudgedSegments = 1e6;
        const double all = scene_.simulation.schedule.frames * static_cast<double>(segments());
        return static_cast<std::uint32_t>(std::ceil(all / kJudgedSegments));
    }

    std::size_t segments() const {
        return setup_.groom.section_count() - 2 * setup_.groom.wisp_count();
    }
    double seconds_of(Stage stage) const {
        return did_.stage_seconds[static_cast<std::size_t>(stage)];
    }

    /// Per frame; `other` is what no stage has: the bodies' poses, the roots' motion, the frame.
    Json stages(double frames) const {
        Json all = Json::object();
        double other = watch_.wall();
        for (std::size_t s = 0; s < static_cast<std::size_t>(Stage::count); ++s) {
            all[stage_name(static_cast<Stage>(s))] = 1e3 * did_.stage_seconds[s] / frames;
            other -= did_.stage_seconds[s];
        }
        all["other"] = 1e3 * other / frames;
        return all;
    }

    /// Per frame, of all but the detections: what a twin with the same contacts has to do.
    double step_milliseconds(double frames) const {
        return 1e3 / frames *
               (seconds_of(Stage::forces) + seconds_of(Stage::velocities) +
                seconds_of(Stage::positions));
    }

    /// [ns] What a stage takes for one of the things that it does.
    Json costs() const {
        const double rows = packet_rows(setup_.groom), steps = static_cast<double>(did_.steps);
        const double sections = static_cast<double>(segments());
        const auto nanoseconds = [&](Stage stage, double things) {
            return ratio(1e9 * seconds_of(stage), things);
        };
        return {{"forces_per_packet", nanoseconds(Stage::forces, rows * steps)},
                {"positions_per_packet", nanoseconds(Stage::positions, rows * steps)},
                {"wisp_detection_per_segment",
                 nanoseconds(Stage::wisp_detection,
                             sections * static_cast<double>(did_.wisp_detections))},
                {"character_detection_per_section",
                 nanoseconds(Stage::character_detection,
                             sections * static_cast<double>(did_.character_detections))},
                {"answer_per_contact",
                 nanoseconds(Stage::velocities, steps * (wisp_contacts() + character_contacts()))}};
    }

    double wisp_contacts() const {
        return ratio(static_cast<double>(did_.friction_contacts + did_.collision_contacts),
                     static_cast<double>(did_.wisp_detections));
    }
    double character_contacts() const {
        return ratio(static_cast<double>(did_.sliding_contacts),
                     static_cast<double>(did_.character_detections));
    }

    /// Engaged at a time, on average.
    Json contacts() const {
        const double detections = static_cast<double>(did_.wisp_detections);
        return {{"friction", ratio(static_cast<double>(did_.friction_contacts), detections)},
                {"collision", ratio(static_cast<double>(did_.collision_contacts), detections)},
                {"sliding", character_contacts()},
                {"intersections_per_segment",
                 ratio(static_cast<double>(did_.intersections),
                       static_cast<double>(did_.intersection_counts * segments()))}};
    }

    const Case& case_;
    SceneDesc scene_;
    RunSetup setup_;
    std::uint32_t preroll_ = 0;
    std::optional<World> world_;
    Watch loading_, watch_;
    Statistics did_;
};

/// What `mane check` finds in the stored frames.
Json quality(const ScratchFile& file) {
    const CheckReport report = check_run(CacheReader(file.path()));
    Json all = Json::object();
    for (const char* name : {"skeleton_inside", "skeleton_depth", "strands_deep", "stretch",
                             "area_mean", "intersections"})
        all[name] = report[name].value;
    return all;
}

} // namespace

Json measure_simulation(const Case& c) {
    Run run(c);
    if (!c.judge) {
        run.simulate(nullptr);
        return run.figures();
    }
    const ScratchFile file;
    CacheWriter cache(file.path(), run.setup());
    run.simulate(&cache);
    cache.finish();
    Json figures = run.figures();
    figures["quality"] = quality(file);
    return figures;
}

double peak_megabytes() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
#ifdef __APPLE__
    return static_cast<double>(used.ru_maxrss) / 1e6;
#else
    return static_cast<double>(used.ru_maxrss) * 1024 / 1e6;
#endif
}

} // namespace mane::bench
