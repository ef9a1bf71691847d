#pragma once

#include "base/aligned.h"
#include "mane/vec.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// A tree of boxes over triangles, sixteen in a node, so that few vector operations test all of
/// them. Its shape is made once, in the rest pose; each new pose only refits the boxes, one pass
/// without sorting or allocation. It stands in for the paper's uniform grid of polygons (§4.2) and
/// finds exactly the same: a grid needs a cell size that fits fine ears and the large triangles of
/// a cap alike, and is refilled from nothing at every detection.
class TriangleTree {
  public:
    static constexpr std::size_t kBoxes = 16;
    struct Box {
        Vec3 low, high;
    };
    /// Sixteen boxes side by side, [axis][box]. What is not in use is where nothing is.
    struct alignas(64) Node {
        float low[3][kBoxes], high[3][kBoxes];
    };
    /// Sixteen triangles side by side, [corner][axis][triangle].
    struct alignas(64) Leaf {
        float corner[3][3][kBoxes] = {};

        std::array<Vec3, 3> triangle(std::size_t i) const {
            const auto at = [&](const float(&c)[3][kBoxes]) {
                return Vec3{c[0][i], c[1][i], c[2][i]};
            };
            return {at(corner[0]), at(corner[1]), at(corner[2])};
        }
        void set(std::size_t i, std::size_t c, const Vec3& p) {
            corner[c][0][i] = p.x, corner[c][1][i] = p.y, corner[c][2][i] = p.z;
        }
    };
    /// Of the triangles of a leaf, [axis][triangle]: the cross product of the edges from the first
    /// corner, along the normal and twice as long as the area [m²].
    struct alignas(64) Areas {
        double axis[3][kBoxes];

        Vec3d of(std::size_t i) const { return {axis[0][i], axis[1][i], axis[2][i]}; }
    };
    /// Triangles that lie together.
    struct Group {
        std::uint32_t first, count; ///< of `order`
    };
    static constexpr std::size_t kGroups = 64;  ///< at most
    static constexpr std::size_t kLevels = 8;   ///< at most
    static constexpr std::size_t kTopNodes = 4; ///< at most: one above them would tell little

    TriangleTree() = default;
    TriangleTree(std::span<const std::array<std::uint32_t, 3>> triangles,
                 std::span<const Vec3> vertices);

    /// Boxes for the triangles in a new pose; `leaves` holds them in the tree's order.
    void refit(std::span<const Leaf> leaves);

    /// The triangles, in the tree's order.
    std::span<const std::uint32_t> order() const { return order_; }
    /// Levels of nodes; the boxes of level 0 are the triangles', sixteen by sixteen in the tree's
    /// order, and those of the next the nodes' of the one before. The last has a few nodes.
    std::size_t levels() const { return first_node_.empty() ? 0 : first_node_.size() - 1; }
    /// How many nodes the last level has.
    std::size_t top_nodes() const {
        return levels() == 0 ? 0 : first_node_.back() - first_node_[levels() - 1];
    }
    const Node& node(std::size_t level, std::size_t i) const {
        return nodes_[first_node_[level] + i];
    }
    /// Every triangle is in one group.
    std::span<const Group> groups() const { return groups_; }
    Box bounds(const Group& group) const;
    /// The box that holds all triangles.
    const Box& bounds() const { return bounds_; }

  private:
    void find_groups();
    Node& node(std::size_t level, std::size_t i) { return nodes_[first_node_[level] + i]; }

    std::vector<std::uint32_t> order_;
    std::vector<std::size_t> first_node_; // of each level, and the end
    AlignedVector<Node> nodes_;           // level after level
    std::vector<Group> groups_;
    Box bounds_;
};

/// The box that holds two.
inline TriangleTree::Box both(const TriangleTree::Box& a, const TriangleTree::Box& b) {
    return {
        {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
        {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

} // namespace mane
