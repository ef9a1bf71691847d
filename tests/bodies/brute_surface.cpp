#include "bodies/brute_surface.h"

#include "base/functions.h"

#include <algorithm>
#include <cmath>

namespace mane::test {

std::vector<Vec3> closed_vertices(const ClosedMesh& closed, const std::vector<Vec3>& vertices) {
    std::vector<Vec3> all = vertices;
    for (const auto& loop : closed.cap_loops) {
        Vec3d sum;
        for (std::uint32_t v : loop)
            sum += Vec3d(vertices[v]);
        all.emplace_back(sum / double(loop.size()));
    }
    return all;
}

double winding_number(const ClosedMesh& closed, const std::vector<Vec3>& vertices, const Vec3d& p) {
    double angle = 0;
    for (const auto& t : closed.triangles) {
        const Vec3d a = Vec3d(vertices[t[0]]) - p, b = Vec3d(vertices[t[1]]) - p,
                    c = Vec3d(vertices[t[2]]) - p;
        const double la = length(a), lb = length(b), lc = length(c);
        const double det = dot(a, cross(b, c));
        const double sum = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        if (det != 0)
            angle += 2 * std::atan2(det, sum);
    }
    return angle / (4 * kPi);
}

double distance_to_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const auto to_edge = [&](const Vec3d& s, const Vec3d& e) {
        const Vec3d way = e - s;
        const double size = dot(way, way);
        const double at = size > 0 ? std::clamp(dot(p - s, way) / size, 0.0, 1.0) : 0.0;
        return length(p - (s + way * at));
    };
    double best = std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
    const Vec3d n = normalized(cross(b - a, c - a));
    const Vec3d foot = p - n * dot(p - a, n);
    const bool over = dot(cross(b - a, foot - a), n) >= 0 && dot(cross(c - b, foot - b), n) >= 0 &&
                      dot(cross(a - c, foot - c), n) >= 0 && dot(n, n) > 0;
    if (over)
        best = std::min(best, std::abs(dot(p - a, n)));
    return best;
}

} // namespace mane::test
