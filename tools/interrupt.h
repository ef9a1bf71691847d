#pragma once

namespace mane::tool {

/// While it lives, the first SIGINT or SIGTERM is noted instead of ending the program, so that a
/// frame in work can be finished and the file closed. One that comes two seconds later or more ends
/// it at once.
class Interrupt {
  public:
    Interrupt();
    ~Interrupt();
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;

    /// The signal that came, or 0.
    int signal() const;
};

} // namespace mane::tool
