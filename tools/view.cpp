#include "commands.h"

#include "mane/cache.h"
#include "mane/check.h"
#include "mane/error.h"
#include "mane/page.h"
#include "mane/world.h"
#include "pages.h"

#include <fmt/core.h>

#include <filesystem>

namespace mane::tool {
namespace {

/// What every frame amounts to, from the frames alone.
void add_figures(const CacheReader& run, PageDesc& page) {
    FrameSeries energy{"kinetic energy", "J", {}}, volume{"volume", "m³", {}},
        penetration{"penetration", "m", {}}, wisps{"kinetic energy", "J", {}};
    for (const FrameFigures& figures : frame_figures(run)) {
        energy.values.push_back(static_cast<float>(figures.kinetic_energy));
        volume.values.push_back(static_cast<float>(figures.volume));
        penetration.values.push_back(static_cast<float>(figures.penetration));
        for (const double e : figures.wisp_kinetic_energy)
            wisps.values.push_back(static_cast<float>(e));
    }
    page.head = {energy, volume, penetration};
    page.wisps = {wisps};
}

float number(const Column& column) {
    return std::visit([](const auto& values) { return static_cast<float>(values.at(0)); },
                      column.values);
}

/// The times and counts that `--record` stored with every frame.
void add_profile(const CacheReader& run, PageDesc& page) {
    std::vector<FrameSeries> series;
    for (std::size_t i = 0; i < run.frame_count(); ++i) {
        const std::vector<Column> table = run.table("PROF", static_cast<std::uint32_t>(i));
        if (table.empty())
            return; // not recorded, or not to the end
        if (series.empty())
            for (const Column& column : table)
                series.push_back({column.name, column.unit, {}});
        if (table.size() != series.size())
            throw InputError(fmt::format("the profile of frame {} has {} columns, expected {}", i,
                                         table.size(), series.size()));
        for (std::size_t c = 0; c < table.size(); ++c)
            series[c].values.push_back(number(table[c]));
    }
    page.head.insert(page.head.end(), series.begin(), series.end());
}

} // namespace

int view(const ViewOptions& options) {
    const CacheReader run(options.file);
    if (!run.damage().empty())
        fmt::print(stderr, "mane: warning: {}: {}\n", options.file, run.damage());
    PageDesc page;
    page.title = std::filesystem::path(options.file).stem().string();
    add_figures(run, page);
    add_profile(run, page);
    write_page(run, page, view_page(), options.output);
    fmt::print("{}: {} frames, {:.1f} MB\n", options.output, run.frame_count(),
               static_cast<double>(std::filesystem::file_size(options.output)) / 1e6);
    return 0;
}

} // namespace mane::tool
