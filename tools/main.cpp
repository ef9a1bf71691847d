#include "commands.h"

#include "mane/error.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <functional>

namespace mane::tool {
namespace {

constexpr const char* kExamples = R"(Examples:
  mane simulate scenes/long.toml -o long.mane
  mane simulate scenes/long.toml -o stiff.mane --set skeleton.bending_length=9cm --frames 48
  mane compare long.mane stiff.mane
  mane info long.mane
  mane help scene skeleton

Exit codes: 0 done, 1 a comparison or a run failed, 2 bad input, 130 or 143 interrupted.)";

using Run = std::function<int()>;

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
    command->add_option("--frames", o.frames, "frames to simulate, instead of the scene's");
    command
        ->add_option("--set", o.settings,
                     "another value for a field of the scene: section.key=value")
        ->allow_extra_args(false);
    command->add_option("--rates", o.rates,
                        "preset of the rates: default, paper, fine, paper-literal");
    command->add_option("--stats", o.statistics, "write the statistics as JSON")
        ->type_name("FILE.json");
    command->add_flag("--record", o.record, "also store times and counts of every frame");
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
    add_compare(app, run);
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

} // namespace
} // namespace mane::tool

int main(int argc, char** argv) {
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
