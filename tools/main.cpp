#include "commands.h"

#include "mane/error.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <cstdlib>
#include <functional>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace mane::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  mane simulate scenes/long.toml -o long.mane
  mane simulate scenes/long.toml -o stiff.mane --set skeleton.bending_length=9cm --frames 48
  mane check long.mane
  mane compare long.mane stiff.mane
  mane extract long.mane --frame 100 -o long.hair
  mane picture long.mane --frame 0 60 120 --view face profile back -o long.png
  mane view long.mane -o long.html
  mane live -o live.html
  mane info long.mane
  mane bench --only styles --runs 3
  mane help scene skeleton

Exit codes: 0 done, 1 a check, a comparison or a run failed, 2 bad input, 130 or 143 interrupted.)";

using Run = std::function<int()>;

/// What both runs and pages may change of a scene.
template <typename Options> void add_scene_changes(CLI::App* command, Options& o) {
    command
        ->add_option("--set", o.settings,
                     "another value for a field of the scene: section.key=value")
        ->allow_extra_args(false);
    command->add_option("--rates", o.rates,
                        "preset of the rates: default, paper, fine, paper-literal");
}

void add_simulate(CLI::App& app, Run& run) {
    static SimulateOptions o;
    CLI::App* command = app.add_subcommand("simulate", "Simulate a scene into a cache");
    command->add_option("SCENE", o.scene, "scene file (TOML)")->required();
    command->add_option("-o,--output", o.output, "cache to write")
        ->required()
        ->type_name("FILE.mane");
    command
        ->add_option("--threads", o.threads,
                     "threads; 0: as many as the machine has; changes no bit of the result")
        ->capture_default_str();
    command->add_option("--instruction-set", o.instruction_set,
                        "avx512, avx2, sse4 or scalar instead of the best; changes no bit either");
    command->add_option("--frames", o.frames, "frames to simulate, instead of the scene's");
    add_scene_changes(command, o);
    command->add_option("--stats", o.statistics, "write the statistics as JSON")
        ->type_name("FILE.json");
    command
        ->add_option("--trace", o.trace,
                     "write when each stage of each step ran, for ui.perfetto.dev; some 13 MB per "
                     "1000 frames")
        ->type_name("FILE.json");
    command->add_flag("--record", o.record,
                      "also store the contacts, times and counts of every frame");
    command->callback([&run] { run = [] { return simulate(o); }; });
}

void add_info(CLI::App& app, Run& run) {
    static InfoOptions o;
    CLI::App* command =
        app.add_subcommand("info", "What a cache holds; reads all of it and checks the checksums");
    command->add_option("FILE", o.file, "cache")->required();
    command->add_flag("--json", o.json, "as JSON");
    command->callback([&run] { run = [] { return info(o); }; });
}

void add_check(CLI::App& app, Run& run) {
    static CheckOptions o;
    CLI::App* command =
        app.add_subcommand("check", "Judge a run by what is stored of it; exit code 1 if it fails");
    command->add_option("FILE", o.file, "cache")->required();
    command->add_flag("--json", o.json, "as JSON");
    command->callback([&run] { run = [] { return check(o); }; });
}

void add_compare(CLI::App& app, Run& run) {
    static CompareOptions o;
    CLI::App* command =
        app.add_subcommand("compare", "Largest and rms difference of two caches, per layer");
    command->add_option("A", o.first, "cache")->required();
    command->add_option("B", o.second, "cache")->required();
    command->add_option("--tolerance", o.tolerance, "differences up to this are none [m, m/s]")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--json", o.json, "as JSON");
    command->callback([&run] { run = [] { return compare(o); }; });
}

void add_extract(CLI::App& app, Run& run) {
    static ExtractOptions o;
    CLI::App* command = app.add_subcommand("extract", "A layer of one frame, for other programs");
    command->add_option("FILE", o.file, "cache")->required();
    command->add_option("-o,--output", o.output, "file to write: .hair, .ply, .obj")->required();
    command->add_option("--frame", o.frame, "frame, from 0")->capture_default_str();
    command->add_option("--layer", o.layer)
        ->check(CLI::IsMember(layer_names()))
        ->capture_default_str();
    command->add_option("--strands", o.strands, "strands on the head, instead of the scene's");
    command->add_option("--samples", o.samples, "points per segment")
        ->check(CLI::Range(1, 64))
        ->capture_default_str();
    command->add_option("--threads", o.threads, "threads; 0: as many as the machine has")
        ->capture_default_str();
    command->callback([&run] { run = [] { return extract(o); }; });
}

#ifdef MANE_HAS_PICTURE
void add_picture(CLI::App& app, Run& run) {
    static PictureOptions o;
    CLI::App* command = app.add_subcommand(
        "picture", "A quick ray-traced picture; several frames or views make a sheet");
    command->add_option("FILE", o.file, "cache")->required();
    command->add_option("-o,--output", o.output, "picture to write")
        ->required()
        ->type_name("OUT.png");
    command->add_option("--frame", o.frames, "frames, from 0")->capture_default_str();
    command->add_option("--layer", o.layer)
        ->check(CLI::IsMember(layer_names()))
        ->capture_default_str();
    command->add_option("--view", o.views, "from where, around the head")
        ->check(CLI::IsMember(view_names()))
        ->capture_default_str();
    command->add_option("--size", o.size, "pixels: width and height, or one for both")
        ->expected(1, 2)
        ->check(CLI::Range(1, 16384))
        ->capture_default_str();
    command->add_option("--strands", o.strands, "strands drawn")->capture_default_str();
    command->add_option("--samples", o.samples, "rays per pixel")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command->add_option("--height", o.height, "metres that a view sees")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    command->add_flag("--colour-by-wisp", o.colour_by_wisp, "each wisp in a colour of its own");
    CLI::Option* eye =
        command->add_option("--eye", o.eye, "camera [m], instead of --view: x y z")->expected(3);
    CLI::Option* target =
        command->add_option("--target", o.target, "what it looks at [m]: x y z")->expected(3);
    eye->needs(target);
    target->needs(eye);
    command->add_option("--field-of-view", o.field_of_view, "of that camera [deg]")
        ->check(CLI::Range(1, 150))
        ->capture_default_str();
    command->add_option("--threads", o.threads, "threads; 0: as many as the machine has")
        ->capture_default_str();
    command->callback([&run] { run = [] { return picture(o); }; });
}
#endif

void add_view(CLI::App& app, Run& run) {
    static ViewOptions o;
    CLI::App* command = app.add_subcommand(
        "view", "A page that plays a cache in a browser: one file, opened without a network");
    command->add_option("FILE", o.file, "cache; with `simulate --record` it knows the contacts")
        ->required();
    command->add_option("-o,--output", o.output, "page to write")
        ->required()
        ->type_name("PAGE.html");
    command->callback([&run] { run = [] { return view(o); }; });
}

void add_live(CLI::App& app, Run& run) {
    static LiveOptions o;
    CLI::App* command = app.add_subcommand(
        "live", "A page that simulates in a browser: drag the head, change parameters");
    command->add_option("SCENE", o.scene,
                        "scene file (TOML) to begin with; the page has the paper's");
    command
        ->add_option("-o,--output", o.output,
                     "page to write, opened without a network; or, ending in /, a folder for a web "
                     "server, which may use threads")
        ->type_name("PAGE.html|FOLDER/");
    command->add_flag("--serve", o.serve, "serve the page on this machine, with threads");
    command->add_option("--port", o.port, "of --serve; 0: any that is free")
        ->check(CLI::Range(0, 65535))
        ->capture_default_str();
    add_scene_changes(command, o);
    command->callback([&run] { run = [] { return live(o); }; });
}

void add_bench(CLI::App& app, Run& run) {
    static BenchOptions o;
    CLI::App* command = app.add_subcommand(
        "bench", "Measure: medians of runs in turn, beside the quality and the machine's peaks");
    command->add_option("--only", o.only, "cases or groups of them, as --list names them");
    command->add_flag("--list", o.list, "name the cases and measure nothing");
    command->add_option("--runs", o.runs, "runs of each case")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_option("--frames", o.frames, "measure at most so many frames of each")
        ->check(CLI::Range(1, 1000000));
    command
        ->add_option("--preroll", o.preroll,
                     "at most so many frames before them: a look, as hair is then jerked off")
        ->check(CLI::Range(0, 1000000));
    command->add_option("--threads", o.threads,
                        "threads of cases on more than one; 0: as many as the machine has");
    command->add_option("--json", o.json, "write all runs and medians")->type_name("FILE.json");
    command->add_option("--csv", o.csv, "write the medians, a file per group")->type_name("DIR");
    command->add_option("--project", o.project, "where scenes/ and bench/scenes/ are")
        ->capture_default_str();
    command->add_option("--plain-core", o.plain_core,
                        "a mane built with MANE_SCALAR, for the case core/plain");
    command->add_option("--twin", o.twin, "tests/runs/bench_twin, for the case core/twin");
    command->add_option("--kernel", o.kernel, "bench/bench_kernel, for the cases kernel/…");
    command->add_option("--plain-kernel", o.plain_kernel,
                        "one built with MANE_SCALAR, for kernel/…/plain");
    command->callback([&run] { run = [] { return bench(o); }; });

    static std::string what;
    CLI::App* one = app.add_subcommand("bench-one", "One run of a case")->group("");
    one->add_option("CASE", what)->required();
    one->callback([&run] { run = [] { return bench_one(what); }; });
}

void add_help(CLI::App& app, Run& run) {
    static HelpSceneOptions o;
    CLI::App* command = app.add_subcommand("help", "Help on scene files");
    command->require_subcommand(1);
    CLI::App* scene =
        command->add_subcommand("scene", "All fields of a scene: default, unit, range, meaning");
    scene->add_option("SECTION", o.section, "only this section");
    scene->add_flag("--schema", o.schema, "as a JSON schema, for editors");
    scene->callback([&run] { run = [] { return help_scene(o); }; });
}

int run_command(int argc, char** argv) {
    CLI::App app{"mane: long hair simulated as layered wisps (Plante, Cani, Poulin 2001)", "mane"};
    app.set_version_flag("--version", "mane " MANE_VERSION);
    app.footer(kExamples);
    app.require_subcommand(1);
    Run run;
    add_simulate(app, run);
    add_info(app, run);
    add_check(app, run);
    add_compare(app, run);
    add_extract(app, run);
#ifdef MANE_HAS_PICTURE
    add_picture(app, run);
#endif
    add_view(app, run);
    add_live(app, run);
    add_bench(app, run);
    add_help(app, run);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0)
            return app.exit(error); // --help, --version
        fmt::print(stderr, "mane: {}; `mane --help` shows how\n", error.what());
        return kBadInput;
    }
    return run();
}

/// What loading took is given back to the system when it is done: glibc would keep whatever is
/// smaller than the largest block that was ever freed.
void give_back_what_is_freed() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

} // namespace
} // namespace mane::tool

int main(int argc, char** argv) {
    mane::tool::give_back_what_is_freed();
    try {
        return mane::tool::run_command(argc, argv);
    } catch (const mane::InputError& error) {
        fmt::print(stderr, "mane: {}\n", error.what());
        return mane::tool::kBadInput;
    } catch (const std::exception& error) {
        fmt::print(stderr, "mane: {}\n", error.what());
        return mane::tool::kFailed;
    }
}
