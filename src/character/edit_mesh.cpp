#include "character/edit_mesh.h"

#include <algorithm>

namespace mane {
namespace {

using Triangle = EditMesh::Triangle;

bool has_corner(const Triangle& t, std::uint32_t v) {
    return t[0] == v || t[1] == v || t[2] == v;
}

Triangle with_corner_replaced(Triangle t, std::uint32_t from, std::uint32_t to) {
    std::replace(t.begin(), t.end(), from, to);
    return t;
}

} // namespace

EditMesh::EditMesh(const Mesh& mesh) : around_(mesh.vertices.size()) {
    for (const Vec3& p : mesh.vertices)
        positions_.emplace_back(p);
    for (const auto& t : mesh.triangles)
        add_triangle(t);
}

Mesh EditMesh::finished() const {
    Mesh mesh;
    std::vector<std::uint32_t> number(positions_.size(), kGone);
    for (std::uint32_t v = 0; v < positions_.size(); ++v)
        if (!around_[v].empty()) {
            number[v] = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.emplace_back(positions_[v]);
        }
    for (const Triangle& t : triangles_)
        if (t[0] != kGone)
            mesh.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    return mesh;
}

std::uint32_t EditMesh::opposite(std::uint32_t a, std::uint32_t b, std::uint32_t& triangle) const {
    for (std::uint32_t t : around_[a])
        for (std::size_t k = 0; k < 3; ++k)
            if (triangles_[t][k] == a && triangles_[t][(k + 1) % 3] == b) {
                triangle = t;
                return triangles_[t][(k + 2) % 3];
            }
    return kGone; // never: the mesh is closed
}

EditMesh::Edge EditMesh::edge(std::size_t t, std::size_t k) const {
    const std::uint32_t a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
    std::uint32_t other = 0;
    return {a, b, triangles_[t][(k + 2) % 3], opposite(b, a, other)};
}

Vec3d EditMesh::area_vector(const Triangle& t) const {
    const Vec3d& a = positions_[t[0]];
    return cross(positions_[t[1]] - a, positions_[t[2]] - a);
}

double EditMesh::least_cosine(std::uint32_t v, const Vec3d& to, const Vec3d& normal) const {
    double least = 1;
    for (std::uint32_t t : around_[v]) {
        Vec3d p[3];
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = triangles_[t][k] == v ? to : positions_[triangles_[t][k]];
        const Vec3d area = cross(p[1] - p[0], p[2] - p[0]);
        least = std::min(least, dot(normalized(area), normal));
    }
    return least;
}

void EditMesh::split(const Edge& e, const Vec3d& middle) {
    std::uint32_t left = 0, right = 0;
    opposite(e.a, e.b, left);
    opposite(e.b, e.a, right);
    const auto m = static_cast<std::uint32_t>(positions_.size());
    positions_.push_back(middle);
    around_.emplace_back();
    set_triangle(left, {e.a, m, e.left});
    set_triangle(right, {m, e.a, e.right});
    add_triangle({m, e.b, e.left});
    add_triangle({e.b, m, e.right});
}

bool EditMesh::joined(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(around_[a].begin(), around_[a].end(),
                       [&](std::uint32_t t) { return has_corner(triangles_[t], b); });
}

std::size_t EditMesh::common_neighbours(std::uint32_t a, std::uint32_t b) const {
    std::size_t count = 0;
    for (std::uint32_t t : around_[a])
        for (std::size_t k = 0; k < 3; ++k) {
            if (triangles_[t][k] != a)
                continue;
            const std::uint32_t next = triangles_[t][(k + 1) % 3]; // each neighbour is it once
            count += next != b && joined(next, b);
        }
    return count;
}

// Would the triangles around `moved` that stay lean away from `normal`, or an edge grow too long?
bool EditMesh::collapse_folds(const Edge& e, std::uint32_t moved, const Vec3d& to,
                              const Vec3d& normal, double longest) const {
    for (std::uint32_t t : around_[moved]) {
        const Triangle& corners = triangles_[t];
        if (has_corner(corners, e.a) && has_corner(corners, e.b))
            continue;
        Vec3d p[3];
        for (std::size_t k = 0; k < 3; ++k) {
            p[k] = corners[k] == moved ? to : positions_[corners[k]];
            if (length(p[k] - to) > longest)
                return true;
        }
        const Vec3d area = cross(p[1] - p[0], p[2] - p[0]);
        if (!(dot(area, normal) > 0.4 * length(area)))
            return true;
    }
    return false;
}

bool EditMesh::collapse(const Edge& e, const Vec3d& to, const Vec3d& normal, double longest) {
    // The link condition: only the two opposite corners neighbour both ends, and they keep three
    // triangles.
    if (common_neighbours(e.a, e.b) != 2)
        return false;
    if (around_[e.left].size() < 4 || around_[e.right].size() < 4)
        return false;
    if (collapse_folds(e, e.a, to, normal, longest) || collapse_folds(e, e.b, to, normal, longest))
        return false;
    std::uint32_t left = 0, right = 0;
    opposite(e.a, e.b, left);
    opposite(e.b, e.a, right);
    remove_triangle(left);
    remove_triangle(right);
    const std::vector<std::uint32_t> moved = around_[e.b];
    for (std::uint32_t t : moved)
        set_triangle(t, with_corner_replaced(triangles_[t], e.b, e.a));
    positions_[e.a] = to;
    return true;
}

namespace {

// Four times the area times √3 over the sum of the squared edges: 1 for an equilateral triangle, 0
// for a flat one.
double shape(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const double edges = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
    return edges > 0 ? 3.4641016151377544 * length(cross(b - a, c - a)) / edges : 0;
}

} // namespace

bool EditMesh::flip_widens(const Edge& e) const {
    const Vec3d &a = positions_[e.a], &b = positions_[e.b];
    const Vec3d &c = positions_[e.left], &d = positions_[e.right];
    const double before = std::min(shape(a, b, c), shape(b, a, d));
    const double after = std::min(shape(c, d, b), shape(d, c, a));
    return after > before * 1.0001; // a margin, so that no edge flips to and fro
}

bool EditMesh::flip(const Edge& e, const Vec3d& normal) {
    if (joined(e.left, e.right) || around_[e.a].size() < 4 || around_[e.b].size() < 4)
        return false;
    const Vec3d &a = positions_[e.a], &b = positions_[e.b];
    const Vec3d &c = positions_[e.left], &d = positions_[e.right];
    if (dot(normalized(cross(d - c, b - c)), normal) < kSteepest)
        return false;
    if (dot(normalized(cross(c - d, a - d)), normal) < kSteepest)
        return false;
    std::uint32_t left = 0, right = 0;
    opposite(e.a, e.b, left);
    opposite(e.b, e.a, right);
    set_triangle(left, {e.left, e.right, e.b});
    set_triangle(right, {e.right, e.left, e.a});
    return true;
}

void EditMesh::set_triangle(std::uint32_t t, const Triangle& corners) {
    remove_triangle(t);
    triangles_[t] = corners;
    for (std::uint32_t v : corners)
        around_[v].push_back(t);
}

void EditMesh::add_triangle(const Triangle& corners) {
    const auto t = static_cast<std::uint32_t>(triangles_.size());
    triangles_.push_back(corners);
    for (std::uint32_t v : corners)
        around_[v].push_back(t);
}

void EditMesh::remove_triangle(std::uint32_t t) {
    for (std::uint32_t v : triangles_[t])
        std::erase(around_[v], t);
    triangles_[t] = {kGone, kGone, kGone};
}

} // namespace mane
