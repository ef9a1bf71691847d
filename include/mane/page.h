#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

/// A run as a page: one HTML file that plays it in a browser, opened from disk, without a network.

namespace mane {

class CacheReader;

/// A number for every frame, or for every wisp of every frame.
struct FrameSeries {
    std::string name;
    std::string unit;
    std::vector<float> values; ///< frames × 1, or frames × wisps
};

/// What a page shows besides the frames themselves.
struct PageDesc {
    std::string title;
    std::vector<FrameSeries> head;  ///< of the whole head, drawn over time
    std::vector<FrameSeries> wisps; ///< of each wisp
};

/// The run as the page's script reads it (docs/view.md): frames in steps of 1 µm as differences in
/// time, the bodies' poses, and the contacts and times of a run with `--record`; packed by zlib's
/// deflate. Throws InputError for a run without frames, positions that are not finite or more than
/// 2 km from the world's origin, or a series of another length.
std::string page_data(const CacheReader& run, const PageDesc& desc);

/// Writes `page`, an HTML text with the line `<!-- data -->`, with the data of the run in that
/// line's place. Throws InputError.
void write_page(const CacheReader& run, const PageDesc& desc, std::string_view page,
                const std::filesystem::path& output);

} // namespace mane
