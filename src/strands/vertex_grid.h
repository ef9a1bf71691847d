#pragma once

#include "base/aligned.h"

#include <cstdint>

namespace mane {

/// The vertices along a wisp that its strands share: p = vertex / samples. A strand has those
/// before its end, and its end. Rows with an entry per vertex of the longest wisp, and some more to
/// be read in packs.
class VertexGrid {
  public:
    /// Throws InputError for no samples.
    VertexGrid(std::uint32_t samples_per_segment, std::uint32_t most_pieces);

    std::uint32_t samples() const { return samples_; }
    std::uint32_t vertices(std::uint32_t pieces) const { return samples_ * pieces + 1; }
    /// How many of them a strand that ends at p = `end` ≥ 1 has: x₁'s, and others unless they are
    /// so near to the end that the last two vertices would be as good as one.
    std::uint32_t before(float end) const;

    const float* parameter() const { return parameter_.data(); } ///< p
    const float* piece() const { return piece_.data(); }         ///< its whole part
    /// Share of control point j (0 … 3) of the four around p in Catmull-Rom curves.
    const float* weight(std::size_t j) const { return weight_[j].data(); }

  private:
    std::uint32_t samples_;
    AlignedVector<float> parameter_, piece_, weight_[4];
};

} // namespace mane
