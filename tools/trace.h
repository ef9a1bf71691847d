#pragma once

#include "mane/world.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace mane::tool {

/// Where a run's time goes, as JSON that ui.perfetto.dev and chrome://tracing open: frames, in them
/// the stages by their names, and the writing of the cache. One line per event. The file is written
/// beside its place and renamed by `finish`.
class Trace {
  public:
    using Time = std::chrono::steady_clock::time_point;

    /// Throws InputError when the file cannot be written.
    explicit Trace(std::filesystem::path file);
    /// Unfinished: removes what it has written.
    ~Trace();
    Trace(const Trace&) = delete;
    Trace& operator=(const Trace&) = delete;

    void add(const StageSpan& span) noexcept;
    /// `frame` counts from the first stored one; those of the preroll are negative.
    void add_frame(std::int64_t frame, Time begin, Time end);
    void add_writing(Time begin, Time end);
    /// Throws InputError when not all could be written.
    void finish();

  private:
    void add(const char* name, const char* category, Time begin, Time end,
             const std::string& more = {});

    std::filesystem::path file_, part_; // the same where it is written in place
    std::ofstream out_;
    Time start_ = std::chrono::steady_clock::now();
    bool finished_ = false;
};

} // namespace mane::tool
