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
/// Boxes that follow each other in the order given lie in one node, so they should be together in
/// space. A box may be anywhere; far from its neighbours it only costs time.
class BoxTree {
  public:
    /// The boxes of sixteen children; those that are not there overlap nothing.
    struct Node {
        alignas(64) float low_x[kLanes];
        float low_y[kLanes], low_z[kLanes], high_x[kLanes], high_y[kLanes], high_z[kLanes];

        Box box(std::size_t c) const {
            return {{low_x[c], low_y[c], low_z[c]}, {high_x[c], high_y[c], high_z[c]}};
        }
        void set(std::size_t c, const Box& box) {
            low_x[c] = box.low.x, low_y[c] = box.low.y, low_z[c] = box.low.z;
            high_x[c] = box.high.x, high_y[c] = box.high.y, high_z[c] = box.high.z;
        }
        void clear() {
            for (std::size_t c = 0; c < kLanes; ++c)
                set(c, Box::nowhere());
        }
        /// The box of all.
        Box hull() const;
    };

    /// Takes the boxes of now.
    void update(std::span<const Box> boxes);

    /// Levels of nodes, 0 for those whose children are boxes; the last has one node.
    std::size_t levels() const { return first_node_.empty() ? 0 : first_node_.size() - 1; }
    const Node& node(std::size_t level, std::size_t i) const {
        return nodes_[first_node_[level] + i];
    }

  private:
    void resize(std::size_t boxes);

    std::size_t size_ = 0;
    std::vector<std::size_t> first_node_;
    AlignedVector<Node> nodes_; ///< level after level
};

} // namespace mane
