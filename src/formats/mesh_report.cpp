#include "mane/import.h"

#include <algorithm>
#include <array>

namespace mane {
namespace {

// A triangle's edge, seen from the lower to the higher vertex.
struct Edge {
    std::uint32_t low, high;
    bool forward; // the triangle goes from low to high
    auto operator<=>(const Edge&) const = default;
    bool same_edge(const Edge& o) const { return low == o.low && high == o.high; }
};

std::vector<Edge> sorted_edges(const Mesh& mesh) {
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), a < b});
        }
    std::sort(edges.begin(), edges.end());
    return edges;
}

bool is_flat(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
    const Vec3d a(mesh.vertices[t[0]]), b(mesh.vertices[t[1]]), c(mesh.vertices[t[2]]);
    const double size = std::max(dot(b - a, b - a), dot(c - a, c - a));
    return !(length(cross(b - a, c - a)) > 1e-12 * size);
}

void append_count(std::string& text, std::size_t count, const char* what) {
    if (count == 0)
        return;
    if (!text.empty())
        text += ", ";
    text += std::to_string(count) + " " + what;
}

} // namespace

std::string MeshReport::warning() const {
    std::string text;
    append_count(text, open_edges, "open edges");
    append_count(text, non_manifold_edges, "non-manifold edges");
    append_count(text, flat_triangles, "triangles without area");
    append_count(text, dropped_triangles, "triangles that name a vertex twice");
    return text;
}

MeshReport inspect_mesh(const Mesh& mesh) {
    MeshReport report;
    const std::vector<Edge> edges = sorted_edges(mesh);
    for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
        while (last < edges.size() && edges[last].same_edge(edges[first]))
            ++last;
        const std::size_t users = last - first;
        if (users == 1)
            ++report.open_edges;
        const bool agree = users == 2 && edges[first].forward != edges[first + 1].forward;
        if (users > 1 && !agree)
            ++report.non_manifold_edges;
    }
    for (const auto& t : mesh.triangles)
        report.flat_triangles += is_flat(mesh, t);
    return report;
}

} // namespace mane
