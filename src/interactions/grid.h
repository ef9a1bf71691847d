#pragma once

#include "base/parallel_for.h"
#include "interactions/segments.h"

#include <cstdint>
#include <vector>

namespace mane {

/// Two segments whose boxes overlap, by their index in ContactGeometry::segments(); a < b.
struct SegmentPair {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    bool operator==(const SegmentPair&) const = default;
};

/// The uniform grid of §4.1. The paper's mailboxes ensure that a pair that shares several cells is
/// tested once; here the pair belongs to the cell of the lowest corner that both boxes share, which
/// needs no memory and no order.
class SegmentGrid {
  public:
    /// All pairs of overlapping boxes, each once, in an order that no thread count changes. The
    /// reference lives until the next call.
    const std::vector<SegmentPair>& overlapping_pairs(const ContactGeometry& geometry,
                                                      Threads& threads);

  private:
    struct Cells {
        Vec3 low;
        float inverse_size = 1;
        std::uint32_t count[3] = {1, 1, 1};
        std::uint32_t coordinate(float x, int axis) const;
    };

    void choose_cells(const ContactGeometry& geometry);
    void fill_cells(const ContactGeometry& geometry);
    void pairs_of_cell(const ContactGeometry& geometry, std::uint32_t cell,
                       std::vector<SegmentPair>& out) const;

    Cells cells_;
    std::vector<std::uint32_t> first_entry_; ///< per cell, and one more
    std::vector<std::uint32_t> entries_;     ///< segments, cell after cell
    std::vector<std::vector<SegmentPair>> chunks_;
    std::vector<SegmentPair> pairs_;
};

} // namespace mane
