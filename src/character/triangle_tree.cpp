#include "character/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace mane {
namespace {

constexpr std::uint32_t kLeaf = 2;

TriangleTree::Box box_of(std::span<const std::array<Vec3, 3>> triangles) {
    TriangleTree::Box box{triangles[0][0], triangles[0][0]};
    for (const auto& corners : triangles) {
        for (const Vec3& p : corners)
            box = both(box, {p, p});
    }
    return box;
}

TriangleTree::Box box_of(const TriangleTree::Node& node) {
    const auto get = [&](std::size_t i) -> TriangleTree::Box {
        return {{node.low[0][i], node.low[1][i], node.low[2][i]},
                {node.high[0][i], node.high[1][i], node.high[2][i]}};
    };
    TriangleTree::Box box = get(0);
    for (std::size_t i = 1; i < node.boxes; ++i)
        box = both(box, get(i));
    return box;
}

void put(const TriangleTree::Box& box, std::size_t i, TriangleTree::Node& node) {
    node.low[0][i] = box.low.x, node.low[1][i] = box.low.y, node.low[2][i] = box.low.z;
    node.high[0][i] = box.high.x, node.high[1][i] = box.high.y, node.high[2][i] = box.high.z;
}

} // namespace

TriangleTree::TriangleTree(std::span<const std::array<std::uint32_t, 3>> triangles,
                           std::span<const Vec3> vertices)
    : order_(triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::vector<Vec3> centres;
    centres.reserve(triangles.size());
    for (const auto& t : triangles)
        centres.push_back(vertices[t[0]] + vertices[t[1]] + vertices[t[2]]);
    if (!triangles.empty())
        split(centres, {0, static_cast<std::uint32_t>(triangles.size())});
}

// Quarters by number, so the depth is log₄ whatever the mesh. A node comes before those in it.
void TriangleTree::split(std::span<const Vec3> centres, Range range) {
    std::array<Range, kBoxes> part{range};
    std::uint32_t parts = 1;
    for (int halving = 0; halving < 2; ++halving) {
        for (std::uint32_t i = parts; i-- > 0;) {
            if (part[i].count > kLeaf)
                part[parts++] = halve(centres, part[i]);
        }
    }

    const std::size_t node = nodes_.size();
    nodes_.emplace_back().boxes = static_cast<std::uint8_t>(parts);
    for (std::uint32_t i = 0; i < parts; ++i) {
        const bool leaf = part[i].count <= kLeaf;
        nodes_[node].first[i] = leaf ? part[i].first : static_cast<std::uint32_t>(nodes_.size());
        nodes_[node].count[i] = static_cast<std::uint8_t>(leaf ? part[i].count : 0);
        if (!leaf)
            split(centres, part[i]);
    }
}

// Cuts a range of `order` along its longest side; the second half is returned. A stable sort, so
// that every library makes the same tree (M39).
TriangleTree::Range TriangleTree::halve(std::span<const Vec3> centres, Range& range) {
    const auto begin = order_.begin() + range.first, end = begin + range.count;
    Box box{centres[*begin], centres[*begin]};
    for (auto t = begin; t != end; ++t)
        box = both(box, {centres[*t], centres[*t]});
    const Vec3 size = box.high - box.low;
    float Vec3::*axis = size.x >= size.y && size.x >= size.z ? &Vec3::x
                        : size.y >= size.z                   ? &Vec3::y
                                                             : &Vec3::z;
    std::stable_sort(begin, end, [&](std::uint32_t a, std::uint32_t b) {
        return centres[a].*axis < centres[b].*axis;
    });
    const std::uint32_t half = range.count / 2, rest = range.count - half;
    range.count = half;
    return {range.first + half, rest};
}

void TriangleTree::refit(std::span<const std::array<Vec3, 3>> corners) {
    for (std::size_t n = nodes_.size(); n-- > 0;) {
        Node& node = nodes_[n];
        for (std::size_t i = 0; i < node.boxes; ++i) {
            const Box box = node.count[i] > 0
                                ? box_of(corners.subspan(node.first[i], node.count[i]))
                                : box_of(nodes_[node.first[i]]);
            put(box, i, node);
        }
    }
    if (!nodes_.empty())
        bounds_ = box_of(nodes_[0]);
}

} // namespace mane
