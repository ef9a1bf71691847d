#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// The subcommands of `mane`, one file each. They return the exit code and throw InputError for bad
/// input; the command line itself is read in main.cpp, the only file that sees CLI11.
namespace mane::tool {

/// Exit codes beside 0. A run that a signal ended gives 128 + the signal, as shells do.
enum Exit { kDifferent = 1, kFailed = 1, kBadInput = 2 };

struct SimulateOptions {
    std::string scene;
    std::string output;
    std::optional<std::uint32_t> frames;
    std::vector<std::string> settings;
    std::string rates;
    std::string statistics;
    std::string trace;
    std::string instruction_set;
    unsigned threads = 1;
    bool record = false;
};
int simulate(const SimulateOptions& options);

struct InfoOptions {
    std::string file;
    bool json = false;
};
int info(const InfoOptions& options);

struct CompareOptions {
    std::string first, second;
    double tolerance = 0;
    bool json = false;
};
int compare(const CompareOptions& options);

/// In the order of PictureLayer; `extract` knows the same.
inline std::vector<std::string> layer_names() {
    return {"strands", "skeleton", "envelope", "character"};
}
/// In the order of View.
inline std::vector<std::string> view_names() {
    return {"face", "three-quarter", "profile", "back"};
}

struct ExtractOptions {
    std::string file, output;
    std::string layer = "strands";
    std::size_t frame = 0;
    std::optional<std::uint32_t> strands;
    std::uint32_t samples = 4; ///< per segment
    unsigned threads = 0;
};
int extract(const ExtractOptions& options);

struct PictureOptions {
    std::string file, output;
    std::string layer = "strands";
    std::vector<std::size_t> frames{0};
    std::vector<std::string> views{"three-quarter"};
    std::vector<std::uint32_t> size{640}; ///< [pixels] width and height, or one for both
    std::uint32_t samples = 16, strands = 30000;
    bool colour_by_wisp = false;
    double height = 0.7;             ///< [m] seen by a view
    std::vector<double> eye, target; ///< [m] three numbers each, or none
    double field_of_view = 24;       ///< [deg]
    unsigned threads = 0;
};
int picture(const PictureOptions& options);

struct ViewOptions {
    std::string file, output;
};
int view(const ViewOptions& options);

struct LiveOptions {
    std::string scene; ///< empty: the page's own
    std::string output;
    std::vector<std::string> settings;
    std::string rates;
    bool serve = false;
    int port = 8750;
};
int live(const LiveOptions& options);

struct CheckOptions {
    std::string file;
    bool json = false;
};
int check(const CheckOptions& options);

struct BenchOptions {
    std::vector<std::string> only; ///< names of cases or of groups of them; empty: all
    std::string project = ".";     ///< holds scenes/ and bench/scenes/
    std::string json, csv;         ///< file, folder; empty: none
    std::string plain_core, twin;  ///< programs for core/plain and core/twin; empty: not measured
    std::string kernel, plain_kernel; ///< programs for kernel/…; empty: not measured
    unsigned threads = 0;
    std::uint32_t runs = 5;
    std::optional<std::uint32_t> frames, preroll;
    bool list = false;
};
int bench(const BenchOptions& options);
/// One run of a case, as JSON in and out: what `bench` starts for each of its runs.
int bench_one(const std::string& what);

struct HelpSceneOptions {
    std::string section;
    bool schema = false;
};
int help_scene(const HelpSceneOptions& options);

} // namespace mane::tool
