#include "character/triangle_tree.h"

#include "base/four.h"
#include "base/sixteens.h"

#include <numeric>

namespace mane {
namespace {

constexpr float kNowhere = 1e30f;

void put(TriangleTree::Node& node, std::size_t i, const Four& low, const Four& high) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        node.low[axis][i] = low[axis];
        node.high[axis][i] = high[axis];
    }
}

void put_nothing(TriangleTree::Node& node, std::size_t i) {
    put(node, i, four(kNowhere), four(-kNowhere));
}

/// Four by four.
void fit(TriangleTree::Node& node, const TriangleTree::Leaf& leaf) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < TriangleTree::kBoxes; i += 4) {
            const auto corner = [&](std::size_t c) {
                const float* p = leaf.corner[c][axis] + i;
                return Four{p[0], p[1], p[2], p[3]};
            };
            const Four a = corner(0), b = corner(1), c = corner(2), low = smaller(smaller(a, b), c),
                       high = larger(larger(a, b), c);
            for (std::size_t n = 0; n < 4; ++n) {
                node.low[axis][i + n] = low[n];
                node.high[axis][i + n] = high[n];
            }
        }
    }
}

/// The boxes of a node, by halves down to one.
template <typename Better>
float best_of(const float (&numbers)[TriangleTree::kBoxes], Better&& better) {
    Four best[4];
    for (std::size_t i = 0; i < 4; ++i)
        best[i] = Four{numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2], numbers[4 * i + 3]};
    const Four one = better(better(best[0], best[1]), better(best[2], best[3]));
    const Four two = better(one, Four{one[2], one[3], one[0], one[1]});
    return better(two, Four{two[1], two[0], two[3], two[2]})[0];
}

TriangleTree::Box bounds_of(const TriangleTree::Node& node) {
    const auto low = [&](std::size_t axis) { return best_of(node.low[axis], smaller); };
    const auto high = [&](std::size_t axis) { return best_of(node.high[axis], larger); };
    return {{low(0), low(1), low(2)}, {high(0), high(1), high(2)}};
}

} // namespace

TriangleTree::TriangleTree(std::span<const std::array<std::uint32_t, 3>> triangles,
                           std::span<const Vec3> vertices)
    : order_(triangles.size()) {
    if (triangles.empty())
        return;
    std::iota(order_.begin(), order_.end(), 0u);
    std::vector<Vec3> centres;
    centres.reserve(triangles.size());
    for (const auto& t : triangles)
        centres.push_back(vertices[t[0]] + vertices[t[1]] + vertices[t[2]]);
    order_by_sixteens(centres, order_);

    std::size_t nodes = 0, boxes = triangles.size();
    first_node_.push_back(0);
    do {
        boxes = (boxes + kBoxes - 1) / kBoxes;
        first_node_.push_back(nodes += boxes);
    } while (boxes > kTopNodes);
    nodes_.resize(nodes);
    for (Node& node : nodes_)
        for (std::size_t i = 0; i < kBoxes; ++i)
            put_nothing(node, i);
    find_groups();
}

// Whole nodes of triangles.
void TriangleTree::find_groups() {
    const std::size_t count = order_.size(), nodes = (count + kBoxes - 1) / kBoxes,
                      size = (nodes + kGroups - 1) / kGroups * kBoxes;
    for (std::size_t first = 0; first < count; first += size)
        groups_.push_back({static_cast<std::uint32_t>(first),
                           static_cast<std::uint32_t>(std::min(size, count - first))});
}

TriangleTree::Box TriangleTree::bounds(const Group& group) const {
    Box box{{kNowhere, kNowhere, kNowhere}, {-kNowhere, -kNowhere, -kNowhere}};
    for (std::uint32_t first = group.first; first < group.first + group.count; first += kBoxes)
        box = both(box, bounds_of(node(0, first / kBoxes)));
    return box;
}

void TriangleTree::refit(std::span<const Leaf> leaves) {
    if (order_.empty())
        return;
    for (std::size_t i = 0; i < leaves.size(); ++i)
        fit(node(0, i), leaves[i]);
    for (std::size_t i = order_.size(); i < leaves.size() * kBoxes; ++i)
        put_nothing(node(0, i / kBoxes), i % kBoxes);
    for (std::size_t level = 1; level < levels(); ++level) {
        const std::size_t below = first_node_[level] - first_node_[level - 1];
        for (std::size_t i = 0; i < below; ++i) {
            const Box box = bounds_of(node(level - 1, i));
            put(node(level, i / kBoxes), i % kBoxes, four(box.low), four(box.high));
        }
    }
    bounds_ = bounds_of(nodes_.back());
    for (std::size_t i = 0; i + 1 < top_nodes(); ++i)
        bounds_ = both(bounds_, bounds_of(node(levels() - 1, i)));
}

} // namespace mane
