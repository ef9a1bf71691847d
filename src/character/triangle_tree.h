#pragma once

#include "base/four.h"
#include "mane/vec.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// A tree of boxes over triangles. Its shape is made once, in the rest pose; each new pose only
/// refits the boxes, one pass without sorting or allocation. It stands in for the paper's uniform
/// grid of polygons (§4.2) and finds exactly the same: a grid needs a cell size that fits fine ears
/// and the large triangles of a cap alike, and is refilled from nothing at every detection.
class TriangleTree {
  public:
    /// A node holds four boxes side by side, [axis][box].
    static constexpr std::size_t kBoxes = 4;
    struct Box {
        Vec3 low, high;
    };
    static constexpr Four kNowhere{1e30f, 1e30f, 1e30f, 1e30f};
    /// Two cache lines.
    struct alignas(64) Node {
        /// What is not in use is where nothing is.
        Four low[3]{kNowhere, kNowhere, kNowhere}, high[3]{-kNowhere, -kNowhere, -kNowhere};
        /// What is in each box: a node, or triangles from this place of `order` on.
        std::array<std::uint32_t, kBoxes> first{};
        std::array<std::uint8_t, kBoxes> count{}; ///< of triangles, 0 for a node
        std::uint8_t boxes = 0;                   ///< in use
    };
    static constexpr std::size_t kDepth = 64; ///< entries that a traversal may have to remember

    TriangleTree() = default;
    TriangleTree(std::span<const std::array<std::uint32_t, 3>> triangles,
                 std::span<const Vec3> vertices);

    /// Boxes for the triangles in a new pose; `corners` holds the triangles in the tree's order.
    void refit(std::span<const std::array<Vec3, 3>> corners);

    std::span<const Node> nodes() const { return nodes_; }
    /// The triangle at each place of the leaves.
    std::span<const std::uint32_t> order() const { return order_; }
    /// The box that holds all triangles.
    const Box& bounds() const { return bounds_; }

  private:
    struct Range {
        std::uint32_t first, count;
    };
    void split(std::span<const Vec3> centres, Range range);
    Range halve(std::span<const Vec3> centres, Range& range);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
    Box bounds_;
};

/// The box that holds two.
inline TriangleTree::Box both(const TriangleTree::Box& a, const TriangleTree::Box& b) {
    return {
        {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
        {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

} // namespace mane
