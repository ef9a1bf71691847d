#pragma once

#include "mane/groom.h"

#include <cstdint>
#include <vector>

namespace mane {

/// Which strands each wisp has: the same in every frame.
class StrandLayout {
  public:
    /// Spreads `strands` over the wisps in proportion to `groom.strands`. Throws InputError for a
    /// wisp too short to draw.
    StrandLayout(const Groom& groom, std::uint32_t strands);

    std::size_t wisp_count() const { return first_strand_.size() - 1; }
    std::size_t strand_count() const { return first_strand_.back(); }
    /// Of wisp `w`; of `wisp_count()`: the number of all strands.
    std::size_t first_strand(std::size_t w) const { return first_strand_[w]; }
    std::size_t wisp_of(std::size_t strand) const;

  private:
    std::vector<std::size_t> first_strand_; // wisps + 1
};

} // namespace mane
