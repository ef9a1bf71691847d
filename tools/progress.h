#pragma once

#include <chrono>
#include <cstddef>

namespace mane::tool {

/// One line on a terminal's standard error that shows how far a run is: share, frames, time left.
/// Silent elsewhere.
class Progress {
  public:
    explicit Progress(std::size_t frames);
    /// Clears the line.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::size_t done);

  private:
    using Clock = std::chrono::steady_clock;
    std::size_t frames_;
    bool terminal_;
    Clock::time_point start_ = Clock::now(), shown_{};
};

} // namespace mane::tool
