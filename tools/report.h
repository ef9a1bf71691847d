#pragma once

#include "mane/world.h"

#include <string>

namespace mane::tool {

/// A run's figures in the paper's terms (§5.3).
struct Report {
    std::string scene;
    std::uint32_t frames = 0;     ///< stored
    double simulated_seconds = 0; ///< preroll included
    double wall_seconds = 0;      ///< from the end of loading to the last frame on disk
    double cpu_seconds = 0; ///< of all threads in that time; less than the wall's on a busy machine
    double writing_seconds = 0; ///< of the wall's, for the cache
    Statistics statistics;
    std::size_t wisps = 0;
    std::size_t segments = 0; ///< simulated ones, of all wisps
    std::uint64_t state_hash = 0;
    unsigned threads = 1;
    std::string instruction_set;
    bool interrupted = false;

    double segments_per_wisp() const;
    /// Other segments that a segment intersects, mean over segments and detections (M40).
    double intersections_per_segment() const;
    double real_time_ratio() const;
    /// Share of the stages' time that goes to finding contacts, and the wisps' part of that.
    double detection_share() const;
    double wisp_share_of_detection() const;
};

/// The report as `--stats` writes it.
std::string to_json(const Report& report);
/// The report as a table, beside the paper's figures.
std::string to_table(const Report& report);

} // namespace mane::tool
