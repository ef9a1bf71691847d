#pragma once

#include "base/aligned.h"
#include "interactions/box.h"
#include "model/layout.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// Boxes by sixteen, so that one vector operation tests all children of a node. It stands in for
/// the paper's grid with mailboxes and finds exactly the same pairs (§4.1, M21).
///
/// Which boxes lie together is settled once, from where they are in the design: hair stays beside
/// the hair that it grew beside. A box may move anywhere; far from its neighbours it only costs
/// time.
class BoxTree {
  public:
    /// The boxes of sixteen children; those that are not there overlap nothing.
    struct Node {
        alignas(64) float low_x[kLanes];
        float low_y[kLanes], low_z[kLanes], high_x[kLanes], high_y[kLanes], high_z[kLanes];
    };

    /// Settles which boxes lie together, by their centres.
    void arrange(std::span<const Vec3> centres);
    /// Takes the boxes of now, in the order of the centres.
    void update(std::span<const Box> boxes);

    std::size_t size() const { return item_.size(); }
    /// Levels of nodes, 0 for those whose children are boxes; the last has one node.
    std::size_t levels() const { return first_node_.empty() ? 0 : first_node_.size() - 1; }
    const Node& node(std::size_t level, std::size_t i) const {
        return nodes_[first_node_[level] + i];
    }
    /// The box that is child `c` of node i of level 0, as numbered by the caller.
    std::uint32_t item(std::size_t i, std::size_t c) const { return item_[i * kLanes + c]; }

  private:
    std::vector<std::uint32_t> item_; ///< in the tree's order
    std::vector<std::size_t> first_node_;
    AlignedVector<Node> nodes_; ///< level after level
};

} // namespace mane
