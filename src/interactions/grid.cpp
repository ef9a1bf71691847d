#include "interactions/grid.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr std::uint32_t kMostCellsPerAxis = 64;
constexpr std::size_t kCellsPerChunk = 256;

float axis_of(const Vec3& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

} // namespace

std::uint32_t SegmentGrid::Cells::coordinate(float x, int axis) const {
    const float c = (x - axis_of(low, axis)) * inverse_size;
    if (!(c > 0))
        return 0;
    return std::min(static_cast<std::uint32_t>(c), count[axis] - 1);
}

void SegmentGrid::choose_cells(const ContactGeometry& geometry) {
    const std::size_t n = geometry.segments().size();
    Box all = geometry.box(0);
    double mean_side = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Box& b = geometry.box(i);
        all.low = {std::min(all.low.x, b.low.x), std::min(all.low.y, b.low.y),
                   std::min(all.low.z, b.low.z)};
        all.high = {std::max(all.high.x, b.high.x), std::max(all.high.y, b.high.y),
                    std::max(all.high.z, b.high.z)};
        const Vec3 side = b.high - b.low;
        mean_side += (side.x + side.y + side.z) / 3.0 / static_cast<double>(n);
    }
    const Vec3 extent = all.high - all.low;
    const float longest = std::max({extent.x, extent.y, extent.z, 1e-6f});
    const float size =
        std::max({static_cast<float>(mean_side), longest / kMostCellsPerAxis, 1e-6f});
    cells_.low = all.low;
    cells_.inverse_size = 1 / size;
    for (int axis = 0; axis < 3; ++axis)
        cells_.count[axis] = 1 + std::min(static_cast<std::uint32_t>(axis_of(extent, axis) / size),
                                          kMostCellsPerAxis);
}

void SegmentGrid::fill_cells(const ContactGeometry& geometry) {
    const auto for_cells_of = [&](const Box& b, auto&& visit) {
        std::uint32_t low[3], high[3];
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = cells_.coordinate(axis_of(b.low, axis), axis);
            high[axis] = cells_.coordinate(axis_of(b.high, axis), axis);
        }
        for (std::uint32_t z = low[2]; z <= high[2]; ++z)
            for (std::uint32_t y = low[1]; y <= high[1]; ++y)
                for (std::uint32_t x = low[0]; x <= high[0]; ++x)
                    visit((z * cells_.count[1] + y) * cells_.count[0] + x);
    };
    const std::size_t n = geometry.segments().size();
    first_entry_.assign(std::size_t{cells_.count[0]} * cells_.count[1] * cells_.count[2] + 1, 0);
    for (std::size_t i = 0; i < n; ++i)
        for_cells_of(geometry.box(i), [&](std::uint32_t c) { ++first_entry_[c + 1]; });
    for (std::size_t c = 1; c < first_entry_.size(); ++c)
        first_entry_[c] += first_entry_[c - 1];
    entries_.resize(first_entry_.back());
    for (std::size_t i = n; i-- > 0;) // backwards, so that a cell's segments come out in order
        for_cells_of(geometry.box(i), [&](std::uint32_t c) {
            entries_[--first_entry_[c + 1]] = static_cast<std::uint32_t>(i);
        });
    // Filling moved every border one place to the left: entry c+1 now holds the beginning of cell
    // c.
    for (std::size_t c = 0; c + 1 < first_entry_.size(); ++c)
        first_entry_[c] = first_entry_[c + 1];
    first_entry_.back() = static_cast<std::uint32_t>(entries_.size());
}

void SegmentGrid::pairs_of_cell(const ContactGeometry& geometry, std::uint32_t cell,
                                std::vector<SegmentPair>& out) const {
    const std::uint32_t begin = first_entry_[cell], end = first_entry_[cell + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
        const Box& a = geometry.box(entries_[i]);
        for (std::uint32_t j = i + 1; j < end; ++j) {
            const Box& b = geometry.box(entries_[j]);
            if (!a.overlaps(b))
                continue;
            const Vec3 corner{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y),
                              std::max(a.low.z, b.low.z)};
            const std::uint32_t owner = (cells_.coordinate(corner.z, 2) * cells_.count[1] +
                                         cells_.coordinate(corner.y, 1)) *
                                            cells_.count[0] +
                                        cells_.coordinate(corner.x, 0);
            if (owner == cell)
                out.push_back({entries_[i], entries_[j]});
        }
    }
}

const std::vector<SegmentPair>& SegmentGrid::overlapping_pairs(const ContactGeometry& geometry,
                                                               Threads& threads) {
    pairs_.clear();
    if (geometry.segments().size() < 2)
        return pairs_;
    choose_cells(geometry);
    fill_cells(geometry);
    const std::size_t cell_count = first_entry_.size() - 1;
    chunks_.resize((cell_count + kCellsPerChunk - 1) / kCellsPerChunk);
    threads.run(chunks_.size(), [&](std::size_t chunk) {
        chunks_[chunk].clear();
        const std::size_t last = std::min(cell_count, (chunk + 1) * kCellsPerChunk);
        for (std::size_t c = chunk * kCellsPerChunk; c < last; ++c)
            pairs_of_cell(geometry, static_cast<std::uint32_t>(c), chunks_[chunk]);
    });
    for (const std::vector<SegmentPair>& chunk : chunks_)
        pairs_.insert(pairs_.end(), chunk.begin(), chunk.end());
    return pairs_;
}

} // namespace mane
