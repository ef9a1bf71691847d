#include "character/surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace mane {
namespace {

/// An edge folded inward by more than this is a crease: 20°. Flatter ones are facets of a smooth
/// hollow (a neck), whose interpolated normals lean by half as much at most.
constexpr double kCreaseSine = 0.34;
/// [m] A pose that strays by less from the one before it is the same but for rounding.
constexpr float kSame = 5e-6f;

/// A triangle's own axes: along its first edge, across it, and its normal.
struct Axes {
    Vec3d origin, along, across, normal;
};
Axes axes_of(const PosedSurface& pose, std::uint32_t t) {
    const Triangle corners = pose.triangle(t);
    const Vec3d along = normalized(corners.b - corners.a), normal = pose.normal(t);
    return {corners.a, along, cross(normal, along), normal};
}

Vec3d turned(const Axes& from, const Axes& to, const Vec3d& d) {
    return to.along * dot(d, from.along) + to.across * dot(d, from.across) +
           to.normal * dot(d, from.normal);
}

} // namespace

Surface::Surface(const Mesh& rest, const std::string& instruction_set)
    : mesh_(close_borders(rest)) {
    closed_vertices_.resize(mesh_.vertex_count + mesh_.cap_loops.size());
    take(rest.vertices);
    poses_.fill(PosedSurface(mesh_.triangles, closed_vertices_, instruction_set));
    find_creases(closed_vertices_);
    sort_by_vertex();
    drift_ = Drift(mesh_.triangles, poses_[0].tree());
    drift_.follow(closed_vertices_, kAtRest, false);
}

void Surface::take(std::span<const Vec3> vertices) {
    std::copy(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(mesh_.vertex_count),
              closed_vertices_.begin());
    for (std::size_t cap = 0; cap < mesh_.cap_loops.size(); ++cap) {
        Vec3d sum;
        for (std::uint32_t v : mesh_.cap_loops[cap])
            sum += Vec3d(vertices[v]);
        closed_vertices_[mesh_.vertex_count + cap] =
            Vec3(sum / static_cast<double>(mesh_.cap_loops[cap].size()));
    }
}

void Surface::take_frames(std::size_t end, std::span<const RigidFrame> frames) {
    std::copy_n(frames.begin(), std::min(frames.size(), Drift::kFrames), frames_[end].begin());
}

void Surface::reset(std::span<const Vec3> vertices, std::span<const RigidFrame> frames) {
    if (!is_at(vertices, frames)) {
        take(vertices);
        poses_[1 - start_].pose(closed_vertices_);
        take_frames(1 - start_, frames);
        drift_.follow(closed_vertices_, frames, strayed_);
        for (std::size_t f = 0; f < drift_.frames(); ++f)
            jumps_ += drift_.of_any(f) > kSame;
        strayed_ = true;
    }
    frames_[start_] = frames_[1 - start_];
    was_reset_ = true;
    duration_ = fastest_ = 0;
}

bool Surface::is_at(std::span<const Vec3> vertices, std::span<const RigidFrame> frames) const {
    const std::size_t count = std::min(frames.size(), Drift::kFrames);
    return count == drift_.frames() &&
           std::equal(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(count),
                      frames_[1 - start_].begin()) &&
           std::equal(vertices.begin(),
                      vertices.begin() + static_cast<std::ptrdiff_t>(mesh_.vertex_count),
                      closed_vertices_.begin());
}

void Surface::advance(std::span<const Vec3> vertices, double duration,
                      std::span<const RigidFrame> frames) {
    start_ = 1 - start_;
    take(vertices);
    poses_[1 - start_].pose(closed_vertices_);
    take_frames(1 - start_, frames);
    drift_.follow(closed_vertices_, frames, strayed_);
    strayed_ = was_reset_ = false;
    ++block_;

    const auto from = start().vertices();
    double farthest = 0;
    for (std::size_t v = 0; v < closed_vertices_.size(); ++v) {
        const Vec3d way = Vec3d(closed_vertices_[v]) - Vec3d(from[v]);
        farthest = std::max(farthest, dot(way, way));
    }
    duration_ = duration;
    fastest_ = std::sqrt(farthest) / duration;
}

// A corner is at a crease when an edge of its vertex is one. Edges with other than two triangles
// count as well: there is no telling which pair is the surface.
void Surface::find_creases(std::span<const Vec3> rest) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
        const auto& corner = mesh_.triangles[t];
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t a = corner[c], b = corner[(c + 1) % 3];
            if (a != b)
                edges[{std::min(a, b), std::max(a, b)}].push_back(t);
        }
    }
    const auto folded_inward = [&](std::uint32_t s, std::uint32_t t) {
        const Triangle a = poses_[0].triangle(s), b = poses_[0].triangle(t);
        const Vec3d n = poses_[0].normal(s), m = poses_[0].normal(t);
        const Vec3d across = (b.a + b.b + b.c) - (a.a + a.b + a.c);
        return dot(n, across) > 0 && (length(cross(n, m)) > kCreaseSine || dot(n, m) < 0);
    };
    std::vector<bool> at_crease(rest.size(), false);
    for (const auto& [edge, uses] : edges) {
        if (uses.size() == 2 && !folded_inward(uses[0], uses[1]))
            continue;
        at_crease[edge.first] = at_crease[edge.second] = true;
    }
    crease_.resize(mesh_.triangles.size());
    for (std::size_t t = 0; t < crease_.size(); ++t) {
        for (std::size_t c = 0; c < 3; ++c)
            crease_[t][c] = at_crease[mesh_.triangles[t][c]];
    }
}

void Surface::sort_by_vertex() {
    at_vertex_.start(closed_vertices_.size());
    for (const auto& corners : mesh_.triangles)
        for (std::uint32_t v : corners)
            at_vertex_.count(v);
    triangles_at_.resize(at_vertex_.add_up());
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
        for (std::uint32_t v : mesh_.triangles[t])
            triangles_at_[at_vertex_.next(v)] = t;
    at_vertex_.finish();
}

// At the start, not unit: the mean of the triangles' by their areas. Asked for at the few vertices
// that hair is about to touch.
Vec3d Surface::vertex_normal(std::uint32_t v) const {
    Vec3d sum;
    for (std::uint32_t i = at_vertex_.first(v); i < at_vertex_.last(v); ++i)
        sum += start().area(triangles_at_[i]);
    return sum;
}

Vec3d Surface::smooth_normal(const SurfacePlace& place) const {
    const Vec3d own = start().normal(place.triangle);
    const auto& corner = mesh_.triangles[place.triangle];
    const auto& crease = crease_[place.triangle];
    const auto at = [&](std::size_t c) {
        return crease[c] ? own : normalized(vertex_normal(corner[c]));
    };
    const Vec3d& weight = place.closest.barycentric;
    const Vec3d mean = at(0) * weight.x + at(1) * weight.y + at(2) * weight.z;
    return dot(mean, own) > 0 ? normalized(mean) : own;
}

Vec3d Surface::carried_point(std::uint32_t t, const Vec3d& p) const {
    const Axes from = axes_of(start(), t), to = axes_of(end(), t);
    return to.origin + turned(from, to, p - from.origin);
}

Vec3d Surface::carried_direction(std::uint32_t t, const Vec3d& d) const {
    return turned(axes_of(start(), t), axes_of(end(), t), d);
}

} // namespace mane
