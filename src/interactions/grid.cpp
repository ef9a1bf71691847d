#include "interactions/grid.h"

#include <algorithm>

namespace mane {
namespace {

constexpr std::uint32_t kMostCellsPerAxis = 64;

} // namespace

void SegmentGrid::choose_cells(const ContactGeometry& geometry) {
    const std::size_t n = geometry.segments().size();
    Box all = geometry.box(0);
    double mean_side = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Box& b = geometry.box(i);
        all.add(b.low);
        all.add(b.high);
        const Vec3 side = b.high - b.low;
        mean_side += (double{side.x} + side.y + side.z) / 3 / static_cast<double>(n);
    }
    // Cells about as large as a segment's box: a point's box then meets one or two cells per axis,
    // and a segment as many.
    const Vec3 extent = all.high - all.low;
    const float longest = std::max({extent.x, extent.y, extent.z, 1e-6f});
    const float size =
        std::max({static_cast<float>(mean_side), longest / kMostCellsPerAxis, 1e-6f});
    low_ = all.low;
    inverse_size_ = 1 / size;
    const auto cells = [size](float side) {
        return 1 + std::min(static_cast<std::uint32_t>(side / size), kMostCellsPerAxis);
    };
    count_ = {cells(extent.x), cells(extent.y), cells(extent.z)};
}

void SegmentGrid::build(const ContactGeometry& geometry) {
    const std::size_t n = geometry.segments().size();
    if (n > 0)
        choose_cells(geometry);
    // A counting sort: sizes, borders, then entries from the back, so that a cell's segments come
    // out in order.
    first_entry_.assign(std::size_t{count_.x} * count_.y * count_.z + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
        for_cells(geometry.box(i), [&](const Cell& c) { ++first_entry_[index(c) + 1]; });
    for (std::size_t c = 1; c < first_entry_.size(); ++c)
        first_entry_[c] += first_entry_[c - 1];
    entries_.resize(first_entry_.back());
    for (std::size_t i = n; i-- > 0;)
        for_cells(geometry.box(i), [&](const Cell& c) {
            entries_[--first_entry_[index(c) + 1]] = static_cast<std::uint32_t>(i);
        });
    // Filling moved every border one place to the left.
    std::move(first_entry_.begin() + 1, first_entry_.end(), first_entry_.begin());
    first_entry_.back() = static_cast<std::uint32_t>(entries_.size());
}

} // namespace mane
