#include "character/closing.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace mane {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>; // lower vertex first

/// Per vertex, the first vertex at the same place. OBJ files split vertices at seams; an artist
/// sees no border there.
std::vector<std::uint32_t> join_vertices(const std::vector<Vec3>& vertices) {
    std::vector<std::uint32_t> order(vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto place = [&](std::uint32_t i) {
        return std::array{vertices[i].x, vertices[i].y, vertices[i].z};
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
    std::vector<std::uint32_t> first(vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && vertices[order[i]] == vertices[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

struct EdgeUse {
    int forward = 0;  ///< triangles that run from the lower to the higher vertex
    int backward = 0; ///< triangles that run the other way
};

std::map<Edge, EdgeUse> count_edges(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::map<Edge, EdgeUse> edges;
    for (const auto& t : triangles) {
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t a = t[c], b = t[(c + 1) % 3];
            if (a < b)
                ++edges[{a, b}].forward;
            if (b < a)
                ++edges[{b, a}].backward;
        }
    }
    return edges;
}

/// Takes a walk over the left-over edges and cuts a loop off each time that it meets itself.
class LoopCutter {
  public:
    explicit LoopCutter(const std::map<Edge, EdgeUse>& edges) {
        for (const auto& [edge, use] : edges) {
            const int rest = use.forward - use.backward;
            for (int i = 0; i < rest; ++i)
                next_[edge.first].push_back(edge.second);
            for (int i = 0; i < -rest; ++i)
                next_[edge.second].push_back(edge.first);
        }
    }

    std::vector<std::vector<std::uint32_t>> loops() {
        std::vector<std::vector<std::uint32_t>> found;
        for (auto& [start, ends] : next_) {
            while (!ends.empty())
                walk(start, found);
        }
        return found;
    }

  private:
    // As many edges arrive at a vertex as leave it, so a walk can only end where it began.
    void walk(std::uint32_t start, std::vector<std::vector<std::uint32_t>>& found) {
        std::vector<std::uint32_t> path{start};
        do {
            auto& ends = next_.at(path.back());
            const std::uint32_t to = ends.back();
            ends.pop_back();
            const auto met = std::find(path.begin(), path.end(), to);
            if (met == path.end()) {
                path.push_back(to);
                continue;
            }
            found.emplace_back(met, path.end());
            path.erase(met + 1, path.end());
        } while (path.size() > 1);
    }

    std::map<std::uint32_t, std::vector<std::uint32_t>> next_;
};

} // namespace

ClosedMesh close_borders(const Mesh& mesh) {
    ClosedMesh closed;
    closed.vertex_count = mesh.vertices.size();
    closed.own_triangles = mesh.triangles.size();
    closed.triangles = mesh.triangles;
    const std::vector<std::uint32_t> first = join_vertices(mesh.vertices);
    for (auto& t : closed.triangles) {
        for (std::uint32_t& corner : t)
            corner = first[corner];
    }

    const std::map<Edge, EdgeUse> edges = count_edges(closed.triangles);
    for (const auto& [edge, use] : edges) {
        closed.open_edges += use.forward + use.backward == 1;
        closed.non_manifold_edges += use.forward + use.backward > 2;
    }
    closed.cap_loops = LoopCutter(edges).loops();
    for (std::size_t cap = 0; cap < closed.cap_loops.size(); ++cap) {
        const auto& loop = closed.cap_loops[cap];
        const auto centre = static_cast<std::uint32_t>(closed.vertex_count + cap);
        for (std::size_t i = 0; i < loop.size(); ++i)
            closed.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], centre});
    }
    return closed;
}

} // namespace mane
