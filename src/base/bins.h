#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
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

} // namespace mane
