#pragma once

#include <chrono>
#include <cstddef>

namespace mane::tool {

/// One line on a terminal's standard error that shows how far a run is: share, frames
/// (or what else is counted), time left.
/// Silent elsewhere.
class Progress {
  public:
    explicit Progress(std::size_t frames, const char* unit = "frame");
    /// Clears the line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::size_t done);

  private:
    using Clock = std::chrono::steady_clock;
    std::size_t frames_;
    const char* unit_;
    bool terminal_;
    Clock::time_point start_ = Clock::now(), shown_{};
};

} // namespace mane::tool
