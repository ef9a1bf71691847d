#include "interactions/box_tree.h"

#include <algorithm>

namespace mane {

Box BoxTree::Node::hull() const {
    const auto least = [](const float* x) { return *std::min_element(x, x + kLanes); };
    const auto most = [](const float* x) { return *std::max_element(x, x + kLanes); };
    return {{least(low_x), least(low_y), least(low_z)}, {most(high_x), most(high_y), most(high_z)}};
}

void BoxTree::resize(std::size_t boxes) {
    size_ = boxes;
    first_node_.clear();
    nodes_.clear();
    if (boxes == 0)
        return;
    std::size_t nodes = 0, children = boxes;
    first_node_.push_back(0);
    do {
        children = (children + kLanes - 1) / kLanes;
        first_node_.push_back(nodes += children);
    } while (children > 1);
    nodes_.resize(nodes);
    for (Node& node : nodes_)
        node.clear();
}

void BoxTree::update(std::span<const Box> boxes) {
    if (boxes.size() != size_)
        resize(boxes.size());
    for (std::size_t i = 0; i < size_; ++i)
        nodes_[i / kLanes].set(i % kLanes, boxes[i]);
    for (std::size_t level = 1; level < levels(); ++level) {
        const std::size_t below = first_node_[level] - first_node_[level - 1];
        for (std::size_t i = 0; i < below; ++i)
            nodes_[first_node_[level] + i / kLanes].set(i % kLanes, node(level - 1, i).hull());
    }
}

} // namespace mane
