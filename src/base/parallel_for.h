#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>

namespace mane {

/// A few threads that run the chunks of a loop. The chunks are the caller's and do not depend on
/// the number of threads, so a loop whose chunks write apart gives the same bits for any number
/// (M39). One loop at a time.
class Threads {
  public:
    /// `count` threads in all, the calling one included; 0: as many as the machine has.
    explicit Threads(unsigned count = 0);
    ~Threads();
    Threads(const Threads&) = delete;
    Threads& operator=(const Threads&) = delete;

    unsigned count() const { return count_; }

    /// Calls `body(c)` once for each c in [0, chunks), in any order, and returns when all are done.
    /// An exception thrown by the lowest failing chunk is thrown again here.
    void run(std::size_t chunks, const std::function<void(std::size_t)>& body);

    /// Calls `body(first, last)` for the ranges of [0, count) that are `per_chunk` long, but for
    /// the last, like `run`.
    template <typename Body>
    void run_ranges(std::size_t count, std::size_t per_chunk, Body&& body) {
        const auto run_chunk = [&](std::size_t c) {
            body(c * per_chunk, std::min(count, (c + 1) * per_chunk));
        };
        run((count + per_chunk - 1) / per_chunk, std::ref(run_chunk)); // a copy would be allocated
    }

  private:
    struct Pool;
    unsigned count_;
    std::unique_ptr<Pool> pool_; // null for one thread
};

} // namespace mane
