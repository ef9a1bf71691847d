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

struct ExtractOptions {
    std::string file;
    std::string output;
    std::uint32_t frame = 0;
    std::string layer = "strands";
    std::optional<std::uint32_t> strands; ///< the scene's if not given
    std::uint32_t samples = 4;            ///< per segment
    unsigned threads = 0;
};
int extract(const ExtractOptions& options);

struct PictureOptions {
    std::string file;
    std::string output;
    std::vector<std::uint32_t> frames = {0}; ///< columns of a contact sheet, if there are several
    std::vector<std::string> views = {"three-quarter"}; ///< its rows
    std::string layer = "strands";
    std::uint32_t size = 640, samples = 16, strands = 30000;
    double height = 0.70;            ///< [m] seen by a view
    std::vector<double> eye, target; ///< [m] in the world, instead of a view
    bool colour_by_wisp = false;
    unsigned threads = 0;
};
/// Only where Embree and libpng were found.
int picture(const PictureOptions& options);

struct HelpSceneOptions {
    std::string section;
    bool schema = false;
};
int help_scene(const HelpSceneOptions& options);

} // namespace mane::tool
