#include "interactions/box_tree.h"

#include <algorithm>

namespace mane {
namespace {

void set(BoxTree::Node& node, std::size_t c, const Box& box) {
    node.low_x[c] = box.low.x, node.low_y[c] = box.low.y, node.low_z[c] = box.low.z;
    node.high_x[c] = box.high.x, node.high_y[c] = box.high.y, node.high_z[c] = box.high.z;
}

Box hull(const BoxTree::Node& node) {
    const auto least = [](const float* x) { return *std::min_element(x, x + kLanes); };
    const auto most = [](const float* x) { return *std::max_element(x, x + kLanes); };
    return {{least(node.low_x), least(node.low_y), least(node.low_z)},
            {most(node.high_x), most(node.high_y), most(node.high_z)}};
}

} // namespace

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
        for (std::size_t c = 0; c < kLanes; ++c)
            set(node, c, Box::nowhere());
}

void BoxTree::update(std::span<const Box> boxes) {
    if (boxes.size() != size_)
        resize(boxes.size());
    for (std::size_t i = 0; i < size_; ++i)
        set(nodes_[i / kLanes], i % kLanes, boxes[i]);
    for (std::size_t level = 1; level < levels(); ++level) {
        const std::size_t below = first_node_[level] - first_node_[level - 1];
        for (std::size_t i = 0; i < below; ++i)
            set(nodes_[first_node_[level] + i / kLanes], i % kLanes, hull(node(level - 1, i)));
    }
}

} // namespace mane
