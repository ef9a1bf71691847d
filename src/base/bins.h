#pragma once

#include "base/parallel_for.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace mane {

/// Sorting by counting: `start`, `count` the bin of every thing, `add_up`, put every thing where
/// `next` of its bin says, `finish`. Then bin b holds the places [first(b), last(b)), in the order
/// in which its things came. Allocates only for more bins than ever before.
class Bins {
  public:
    void start(std::size_t bins) { first_.assign(bins + 1, 0); }
    void count(std::size_t bin) { ++first_[bin + 1]; }
    /// Returns how many things were counted.
    std::uint32_t add_up() {
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        return first_.back();
    }
    std::uint32_t next(std::size_t bin) { return first_[bin]++; }
    void finish() { // filling moved every beginning on to its end
        std::move_backward(first_.begin(), first_.end() - 1, first_.end());
        first_.front() = 0;
    }

    std::size_t size() const { return first_.size() - 1; }
    std::uint32_t first(std::size_t bin) const { return first_[bin]; }
    std::uint32_t last(std::size_t bin) const { return first_[bin + 1]; }

  private:
    std::vector<std::uint32_t> first_; // per bin, and one more
};

/// The same by several threads, in one go: things are counted in parts, and each part puts its
/// things behind those of the parts before. So the order is that in which things come, however
/// many parts there are.
class ParallelBins {
  public:
    /// Calls `put(i, place)` for every i in [0, count), by the bins `bin_of(i)` in [0, bins).
    template <typename BinOf, typename Put>
    void sort(Threads& threads, std::size_t bins, std::size_t count, BinOf&& bin_of, Put&& put) {
        constexpr std::size_t kLeastPart = 32768, kMostParts = 8;
        const std::size_t parts = std::clamp<std::size_t>(count / kLeastPart, 1, kMostParts);
        const std::size_t length = (count + parts - 1) / parts;
        next_.assign(parts * bins, 0);
        threads.run_ranges(count, std::max<std::size_t>(length, 1), [&](auto first, auto last) {
            std::uint32_t* number = next_.data() + first / length * bins;
            for (std::size_t i = first; i < last; ++i)
                ++number[bin_of(i)];
        });
        add_up(parts, bins);
        threads.run_ranges(count, std::max<std::size_t>(length, 1), [&](auto first, auto last) {
            std::uint32_t* next = next_.data() + first / length * bins;
            for (std::size_t i = first; i < last; ++i)
                put(i, next[bin_of(i)]++);
        });
    }

    std::uint32_t first(std::size_t bin) const { return first_[bin]; }
    std::uint32_t last(std::size_t bin) const { return first_[bin + 1]; }

  private:
    void add_up(std::size_t parts, std::size_t bins) {
        first_.resize(bins + 1);
        std::uint32_t sum = 0;
        for (std::size_t b = 0; b < bins; ++b) {
            first_[b] = sum;
            for (std::size_t p = 0; p < parts; ++p)
                sum += std::exchange(next_[p * bins + b], sum);
        }
        first_[bins] = sum;
    }

    std::vector<std::uint32_t> first_; // per bin, and one more
    std::vector<std::uint32_t> next_;  // scratch: per part and bin
};

} // namespace mane
