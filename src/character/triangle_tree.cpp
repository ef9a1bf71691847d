#include "character/triangle_tree.h"

#include <algorithm>
#include <numeric>

namespace mane {
namespace {

constexpr std::uint32_t kLeaf = 4;

Vec3 lower(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
Vec3 upper(const Vec3& a, const Vec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
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
        split(centres, 0, static_cast<std::uint32_t>(triangles.size()));
}

// Halves by number along the longest side, so the depth is log₂ whatever the mesh; a stable sort,
// so that every library makes the same tree (M39).
void TriangleTree::split(std::span<const Vec3> centres, std::uint32_t first, std::uint32_t count) {
    const std::size_t node = nodes_.size();
    nodes_.push_back({{}, {}, first, count});
    if (count <= kLeaf)
        return;

    Vec3 low = centres[order_[first]], high = low;
    for (std::uint32_t i = first; i < first + count; ++i) {
        low = lower(low, centres[order_[i]]);
        high = upper(high, centres[order_[i]]);
    }
    const Vec3 size = high - low;
    float Vec3::*axis = size.x >= size.y && size.x >= size.z ? &Vec3::x
                        : size.y >= size.z                   ? &Vec3::y
                                                             : &Vec3::z;
    std::stable_sort(
        order_.begin() + first, order_.begin() + first + count,
        [&](std::uint32_t a, std::uint32_t b) { return centres[a].*axis < centres[b].*axis; });
    const std::uint32_t half = count / 2;
    split(centres, first, half);
    nodes_[node].next = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].count = 0;
    split(centres, first + half, count - half);
}

void TriangleTree::refit(std::span<const std::array<Vec3, 3>> corners) {
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.count == 0) {
            node.low = lower(nodes_[i + 1].low, nodes_[node.next].low);
            node.high = upper(nodes_[i + 1].high, nodes_[node.next].high);
            continue;
        }
        node.low = node.high = corners[node.next][0];
        for (std::uint32_t t = node.next; t < node.next + node.count; ++t) {
            for (const Vec3& p : corners[t]) {
                node.low = lower(node.low, p);
                node.high = upper(node.high, p);
            }
        }
    }
}

} // namespace mane
