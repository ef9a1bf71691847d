#include "progress.h"

#include <fmt/core.h>

#include <cstdio>
#include <string>
#include <unistd.h>

namespace mane::tool {

Progress::Progress(std::size_t frames, const char* unit)
    : frames_(frames), unit_(unit), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (terminal_)
        fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(std::size_t done) {
    const Clock::time_point now = Clock::now();
    // Ten times a second is as smooth as anyone can read.
    if (!terminal_ || (now - shown_ < std::chrono::milliseconds(100) && done < frames_))
        return;
    shown_ = now;
    const double share = static_cast<double>(done) / static_cast<double>(frames_);
    const double spent = std::chrono::duration<double>(now - start_).count();
    const std::size_t width = 32,
                      full = static_cast<std::size_t>(share * static_cast<double>(width));
    std::string bar;
    for (std::size_t i = 0; i < width; ++i)
        bar += i < full ? "━" : "·";
    fmt::print(stderr, "\r\x1b[K{} {:3.0f} %  {} {}/{}", bar, 100 * share, unit_, done, frames_);
    if (done > 0)
        fmt::print(stderr, "  {:.1f} {}s/s, {:.0f} s left", static_cast<double>(done) / spent,
                   unit_, spent / share - spent);
    std::fflush(stderr);
}

} // namespace mane::tool
