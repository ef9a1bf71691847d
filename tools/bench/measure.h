#pragma once

#include "bench/cases.h"
#include "bench/sample.h"

#include <chrono>
#include <ctime>

namespace mane::bench {

/// One run of a case, each in a process of its own: what it took.
Json measure_simulation(const Case& c);
Json measure_strands(const Case& c);
Json measure_cache(const Case& c);
Json measure_machine(const Case& c);

/// Most memory that this process has had at once [MB].
double peak_megabytes();

/// Wall and processor time that runs, and can be held.
class Watch {
  public:
    void go() {
        wall_start_ = Clock::now();
        cpu_start_ = std::clock();
    }
    void hold() {
        wall_ += std::chrono::duration<double>(Clock::now() - wall_start_).count();
        cpu_ += static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC;
    }
    double wall() const { return wall_; } ///< [s]
    double cpu() const { return cpu_; }   ///< [s] of all threads

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point wall_start_;
    std::clock_t cpu_start_ = 0;
    double wall_ = 0, cpu_ = 0;
};

} // namespace mane::bench
