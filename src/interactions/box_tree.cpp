#include "interactions/box_tree.h"

#include <numeric>

namespace mane {
namespace {

constexpr float kFarAway = 1e30f;

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

/// The bits of x with two zeros after each: a third of a place on Morton's curve.
std::uint64_t spread(std::uint32_t x) {
    std::uint64_t spread = 0;
    for (int bit = 0; bit < 20; ++bit)
        spread |= std::uint64_t{x >> bit & 1} << 3 * bit;
    return spread;
}

std::vector<std::uint64_t> places_on_curve(std::span<const Vec3> centres) {
    Box all{centres[0], centres[0]};
    for (const Vec3& c : centres)
        all.add(c);
    const Vec3 extent = all.high - all.low;
    const float scale = 1048575.f / std::max({extent.x, extent.y, extent.z, 1e-6f});
    const auto along = [scale](float x) { return spread(static_cast<std::uint32_t>(x * scale)); };
    std::vector<std::uint64_t> places;
    for (const Vec3& c : centres)
        places.push_back(along(c.x - all.low.x) | along(c.y - all.low.y) << 1 |
                         along(c.z - all.low.z) << 2);
    return places;
}

} // namespace

void BoxTree::arrange(std::span<const Vec3> centres) {
    item_.resize(centres.size());
    std::iota(item_.begin(), item_.end(), 0u);
    first_node_.clear();
    nodes_.clear();
    if (centres.empty())
        return;
    const std::vector<std::uint64_t> place = places_on_curve(centres);
    std::stable_sort(item_.begin(), item_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return place[a] < place[b]; });
    std::size_t nodes = 0, children = centres.size();
    first_node_.push_back(0);
    do {
        children = (children + kLanes - 1) / kLanes;
        first_node_.push_back(nodes += children);
    } while (children > 1);
    nodes_.resize(nodes);
    const Vec3 far{kFarAway, kFarAway, kFarAway};
    for (Node& node : nodes_)
        for (std::size_t c = 0; c < kLanes; ++c)
            set(node, c, {far, -far});
}

void BoxTree::update(std::span<const Box> boxes) {
    for (std::size_t i = 0; i < item_.size(); ++i)
        set(nodes_[i / kLanes], i % kLanes, boxes[item_[i]]);
    for (std::size_t level = 1; level < levels(); ++level) {
        const std::size_t below = first_node_[level] - first_node_[level - 1];
        for (std::size_t i = 0; i < below; ++i)
            set(nodes_[first_node_[level] + i / kLanes], i % kLanes, hull(node(level - 1, i)));
    }
}

} // namespace mane
