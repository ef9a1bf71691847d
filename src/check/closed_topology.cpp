#include "check/closed_topology.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace mane::judge {
namespace {

/// Every vertex's first one at the same place: files repeat vertices along seams.
std::vector<std::uint32_t> joined_vertices(const std::vector<Vec3>& vertices) {
    std::map<std::tuple<float, float, float>, std::uint32_t> first;
    std::vector<std::uint32_t> joined;
    joined.reserve(vertices.size());
    for (const Vec3& v : vertices)
        joined.push_back(
            first.try_emplace({v.x, v.y, v.z}, std::uint32_t(joined.size())).first->second);
    return joined;
}

/// Sets of connected vertices.
struct Connected {
    std::vector<std::uint32_t> parent;

    explicit Connected(std::size_t count) : parent(count) {
        std::iota(parent.begin(), parent.end(), 0u);
    }
    std::uint32_t root(std::uint32_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    }
    void connect(std::uint32_t a, std::uint32_t b) { parent[root(a)] = root(b); }
};

} // namespace

ClosedTopology::ClosedTopology(const Mesh& mesh) {
    const std::vector<std::uint32_t> joined = joined_vertices(mesh.vertices);
    // How often triangles run along an edge from its lower to its higher vertex, less how often the
    // other way: zero on every edge of a closed surface. What is left over has no ends itself, so
    // cones over it close any mesh, whatever its faults.
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> excess;
    for (const auto& t : mesh.triangles) {
        triangles_.push_back({joined[t[0]], joined[t[1]], joined[t[2]]});
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t a = triangles_.back()[i], b = triangles_.back()[(i + 1) % 3];
            if (a != b)
                excess[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    std::erase_if(excess, [](const auto& edge) { return edge.second == 0; });

    Connected parts(mesh.vertices.size());
    for (const auto& [edge, count] : excess)
        parts.connect(edge.first, edge.second);
    std::map<std::uint32_t, std::uint32_t> apex; // of each part
    for (const auto& [edge, count] : excess) {
        const auto [a, b] = edge;
        const auto [found, added] =
            apex.try_emplace(parts.root(a), std::uint32_t(mesh.vertices.size() + borders_.size()));
        if (added)
            borders_.emplace_back();
        auto& border = borders_[found->second - mesh.vertices.size()];
        border.insert(border.end(), {a, b});
        for (int i = 0; i < count; ++i)
            triangles_.push_back({b, a, found->second});
        for (int i = 0; i < -count; ++i)
            triangles_.push_back({a, b, found->second});
    }
}

std::vector<Vec3d> ClosedTopology::positions(std::span<const Vec3> vertices) const {
    std::vector<Vec3d> all(vertices.begin(), vertices.end());
    for (const auto& border : borders_) {
        Vec3d sum;
        for (const std::uint32_t v : border)
            sum += Vec3d(vertices[v]);
        all.push_back(sum / static_cast<double>(border.size()));
    }
    return all;
}

} // namespace mane::judge
