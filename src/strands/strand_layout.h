#pragma once

#include "mane/groom.h"

#include <cstdint>
#include <vector>

namespace mane {

/// Which strands there are and where their vertices go: the same in every frame.
class StrandLayout {
  public:
    struct Wisp {
        std::size_t first_strand = 0;
        std::size_t first_vertex = 0;
        std::uint32_t vertices = 0; ///< of each of its strands
    };

    /// Spreads `strands` over the wisps in proportion to `groom.strands`. Throws InputError for no
    /// samples.
    StrandLayout(const Groom& groom, std::uint32_t strands, std::uint32_t samples_per_segment);

    std::size_t strand_count() const { return wisps_.back().first_strand; }
    std::size_t vertex_count() const { return wisps_.back().first_vertex; }
    std::uint32_t samples() const { return samples_; }
    std::size_t wisp_of(std::size_t strand) const;
    std::size_t first_vertex(std::size_t strand) const;
    /// Strands, vertices of wisp `w`.
    const Wisp& wisp(std::size_t w) const { return wisps_[w]; }

  private:
    std::uint32_t samples_;
    std::vector<Wisp> wisps_; // and one behind the last
};

} // namespace mane
