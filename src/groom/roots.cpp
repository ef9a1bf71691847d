#include "groom/roots.h"

#include "groom/nearest_point.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace mane {
namespace {

constexpr std::size_t kCandidates = 40; // per root: enough that gaps differ by a few percent only
constexpr int kRelaxations = 20;
constexpr std::uint64_t kRootNumbers =
    0x726f6f74; // keeps these random numbers apart from the wisps' own

Vec3d corner(const Mesh& mesh, std::uint32_t triangle, std::size_t k) {
    return Vec3d(mesh.vertices[mesh.triangles[triangle][k]]);
}

ScalpPoint scalp_point(const Mesh& mesh, std::uint32_t triangle, double a, double b) {
    const Vec3d p = corner(mesh, triangle, 0), q = corner(mesh, triangle, 1),
                r = corner(mesh, triangle, 2);
    return {triangle,
            {1 - a - b, a, b},
            p * (1 - a - b) + q * a + r * b,
            normalized(cross(q - p, r - p))};
}

// Random points with the same density everywhere: stratified over the running sum of areas.
std::vector<ScalpPoint> candidates(const Mesh& mesh, std::span<const std::uint32_t> scalp,
                                   std::size_t count, std::uint32_t seed) {
    std::vector<double> sum(scalp.size());
    double total = 0;
    for (std::size_t i = 0; i < scalp.size(); ++i) {
        const Vec3d p = corner(mesh, scalp[i], 0);
        total += length(cross(corner(mesh, scalp[i], 1) - p, corner(mesh, scalp[i], 2) - p)) / 2;
        sum[i] = total;
    }
    std::vector<ScalpPoint> points;
    std::size_t triangle = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Random random(seed, kRootNumbers, i);
        const double at =
            total * (static_cast<double>(i) + double{random.unit(0)}) / static_cast<double>(count);
        while (triangle + 1 < scalp.size() && sum[triangle] < at)
            ++triangle;
        double a = random.unit(1), b = random.unit(2);
        if (a + b > 1)
            a = 1 - a, b = 1 - b;
        points.push_back(scalp_point(mesh, scalp[triangle], a, b));
    }
    return points;
}

double squared_distance(const Vec3d& a, const Vec3d& b) {
    return dot(a - b, a - b);
}

// Candidates that follow each other, which lie together because they are sorted by triangle.
struct Cluster {
    static constexpr std::size_t kSize = 64;
    Vec3d low, high;
    double widest = std::numeric_limits<double>::infinity(); // of the gaps in it
    std::size_t where;                                       // the first candidate that has it

    double squared_distance_to(const Vec3d& p) const {
        const Vec3d way{std::max({low.x - p.x, p.x - high.x, 0.0}),
                        std::max({low.y - p.y, p.y - high.y, 0.0}),
                        std::max({low.z - p.z, p.z - high.z, 0.0})};
        return dot(way, way);
    }
};

std::vector<Cluster> clusters_of(const std::vector<ScalpPoint>& from) {
    std::vector<Cluster> clusters;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3d& p = from[i].position;
        if (i % Cluster::kSize == 0)
            clusters.push_back({.low = p, .high = p, .where = i});
        Vec3d &low = clusters.back().low, &high = clusters.back().high;
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return clusters;
}

// Each next one is the candidate that is farthest from those chosen before. It narrows no gap of a
// cluster that is farther from it than the widest of them, so such clusters are passed by: all
// pairs would take a minute for ten thousand wisps.
std::vector<std::size_t> farthest_first(const std::vector<ScalpPoint>& from, std::size_t count) {
    std::vector<double> gap(from.size(), std::numeric_limits<double>::infinity());
    std::vector<Cluster> clusters = clusters_of(from);
    std::vector<std::size_t> chosen;
    for (std::size_t next = 0; chosen.size() < count;) {
        chosen.push_back(next);
        const Vec3d& taken = from[next].position;
        for (Cluster& cluster : clusters) {
            if (cluster.squared_distance_to(taken) >= cluster.widest)
                continue;
            const std::size_t begin = cluster.where / Cluster::kSize * Cluster::kSize,
                              end = std::min(begin + Cluster::kSize, from.size());
            for (std::size_t i = begin; i < end; ++i)
                gap[i] = std::min(gap[i], squared_distance(from[i].position, taken));
            const auto widest = std::max_element(&gap[begin], &gap[begin] + (end - begin));
            cluster.widest = *widest;
            cluster.where = static_cast<std::size_t>(widest - gap.data());
        }
        const auto narrower = [](const Cluster& a, const Cluster& b) {
            return a.widest < b.widest;
        };
        next = std::max_element(clusters.begin(), clusters.end(), narrower)->where;
    }
    return chosen;
}

// Lloyd: each chosen point goes to the candidate nearest to the middle of those that are nearest to
// it. This takes the chosen ones off the border, where farthest-first puts too many.
void relax(const std::vector<Vec3d>& from, const NearestPoint& nearest_from,
           std::vector<std::size_t>& chosen) {
    std::vector<Vec3d> position;
    position.reserve(chosen.size());
    for (const std::size_t c : chosen)
        position.push_back(from[c]);
    const NearestPoint owner(position);
    std::vector<Vec3d> sum(chosen.size());
    std::vector<double> members(chosen.size());
    for (const Vec3d& p : from) {
        const std::size_t o = owner(p);
        sum[o] += p;
        members[o] += 1;
    }
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (members[i] > 0)
            chosen[i] = nearest_from(sum[i] / members[i]);
}

} // namespace

std::vector<ScalpPoint> spread_roots(const Mesh& mesh, std::span<const std::uint32_t> scalp,
                                     std::size_t count, std::uint32_t seed,
                                     const std::function<bool(const ScalpPoint&)>& accept,
                                     const std::function<Vec3d(const ScalpPoint&)>& upstream) {
    std::vector<ScalpPoint> from = candidates(mesh, scalp, count * kCandidates, seed);
    std::erase_if(from, [&](const ScalpPoint& p) { return !accept(p); });
    if (from.size() <= count)
        return from;
    std::vector<std::size_t> chosen = farthest_first(from, count);
    std::vector<Vec3d> position;
    position.reserve(from.size());
    for (const ScalpPoint& p : from)
        position.push_back(p.position);
    const NearestPoint nearest(position);
    for (int i = 0; i < kRelaxations; ++i)
        relax(position, nearest, chosen);
    std::vector<ScalpPoint> roots;
    for (std::size_t c : chosen) {
        const Vec3d goal = from[c].position + upstream(from[c]);
        roots.push_back(from[nearest(goal)]);
    }
    return roots;
}

std::vector<Vec3d> region_border(const Mesh& mesh, std::span<const std::uint32_t> scalp) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> used;
    for (std::uint32_t t : scalp)
        for (std::size_t k = 0; k < 3; ++k)
            ++used[std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])];
    std::vector<Vec3d> border;
    for (const auto& [edge, count] : used)
        if (count == 1)
            border.push_back(
                (Vec3d(mesh.vertices[edge.first]) + Vec3d(mesh.vertices[edge.second])) / 2);
    return border;
}

} // namespace mane
