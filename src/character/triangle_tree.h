#pragma once

#include "mane/vec.h"

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
    struct Node {
        Vec3 low, high;
        std::uint32_t next = 0;  ///< leaf: its first place in `order`; else its second child (the
                                 ///< first one follows it)
        std::uint32_t count = 0; ///< triangles of a leaf, 0 for an inner node
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

  private:
    void split(std::span<const Vec3> centres, std::uint32_t first, std::uint32_t count);

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

} // namespace mane
