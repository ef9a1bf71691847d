#pragma once

#include "interactions/segments.h"

#include <cstdint>
#include <vector>

namespace mane {

/// The uniform grid of §4.1: every segment is named in each cell that its box overlaps. The paper's
/// mailboxes ensure that a segment met in several cells is tested once; here a meeting belongs to
/// the cell of the lowest corner that both boxes share, which needs no memory, so that queries can
/// run in parallel.
class SegmentGrid {
  public:
    /// Sorts the segments into cells anew. Allocates only where a call needs more than any before.
    void build(const ContactGeometry& geometry);

    /// Calls `visit` once with the index of every segment whose box overlaps `box`, in a fixed
    /// order.
    template <typename Visit>
    void for_overlapping(const ContactGeometry& geometry, const Box& box, Visit&& visit) const;

  private:
    struct Cell {
        std::uint32_t x, y, z;
        bool operator==(const Cell&) const = default;
    };
    Cell cell_of(const Vec3& p) const;
    std::uint32_t index(const Cell& c) const { return (c.z * count_.y + c.y) * count_.x + c.x; }
    template <typename Visit> void for_cells(const Box& box, Visit&& visit) const;
    void choose_cells(const ContactGeometry& geometry);

    Vec3 low_;
    float inverse_size_ = 1;
    Cell count_{1, 1, 1};
    std::vector<std::uint32_t> first_entry_; ///< per cell, and one more
    std::vector<std::uint32_t> entries_;     ///< segments, cell after cell
};

inline SegmentGrid::Cell SegmentGrid::cell_of(const Vec3& p) const {
    // Outside the grid the border cells answer: rounding of a corner may fall a little out.
    const auto along = [this](float x, float low, std::uint32_t count) {
        const float c = (x - low) * inverse_size_;
        return c > 0 ? std::min(static_cast<std::uint32_t>(c), count - 1) : 0u;
    };
    return {along(p.x, low_.x, count_.x), along(p.y, low_.y, count_.y),
            along(p.z, low_.z, count_.z)};
}

template <typename Visit> void SegmentGrid::for_cells(const Box& box, Visit&& visit) const {
    const Cell low = cell_of(box.low), high = cell_of(box.high);
    for (std::uint32_t z = low.z; z <= high.z; ++z)
        for (std::uint32_t y = low.y; y <= high.y; ++y)
            for (std::uint32_t x = low.x; x <= high.x; ++x)
                visit(Cell{x, y, z});
}

template <typename Visit> void SegmentGrid::for_overlapping(const ContactGeometry& geometry,
                                                            const Box& box, Visit&& visit) const {
    for_cells(box, [&](const Cell& cell) {
        const std::uint32_t c = index(cell);
        for (std::uint32_t e = first_entry_[c]; e < first_entry_[c + 1]; ++e) {
            const Box& other = geometry.box(entries_[e]);
            if (!box.overlaps(other))
                continue;
            const Vec3 corner{std::max(box.low.x, other.low.x), std::max(box.low.y, other.low.y),
                              std::max(box.low.z, other.low.z)};
            if (cell_of(corner) == cell)
                visit(entries_[e]);
        }
    });
}

} // namespace mane
