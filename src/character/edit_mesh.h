#pragma once

#include "mane/body.h"

#include <array>
#include <optional>
#include <vector>

namespace mane {

// A closed manifold mesh whose edges can be split, collapsed and flipped. Every operation keeps it
// closed and manifold, or refuses.
class EditMesh {
  public:
    using Triangle = std::array<std::uint32_t, 3>;

    explicit EditMesh(const Mesh& mesh);
    Mesh finished() const; // unused vertices and triangles removed, order kept

    std::size_t vertex_slots() const { return positions_.size(); }
    std::size_t triangle_slots() const { return triangles_.size(); }
    bool has_triangle(std::size_t t) const { return triangles_[t][0] != kGone; }
    const Triangle& triangle(std::size_t t) const { return triangles_[t]; }
    const std::vector<std::uint32_t>& triangles_around(std::uint32_t v) const { return around_[v]; }
    const Vec3d& position(std::uint32_t v) const { return positions_[v]; }
    void move(std::uint32_t v, const Vec3d& to) { positions_[v] = to; }

    // An edge a–b and the corners opposite to it: triangles (a, b, left) and (b, a, right).
    struct Edge {
        std::uint32_t a, b, left, right;
    };
    // The edge from corner k of triangle t to the next.
    Edge edge(std::size_t t, std::size_t k) const;

    // Twice the area, along the normal.
    Vec3d area_vector(const Triangle& t) const;

    // With vertex v at `to`: the least cosine between `normal` and the normals of the triangles
    // around v.
    double least_cosine(std::uint32_t v, const Vec3d& to, const Vec3d& normal) const;

    void split(const Edge& e, const Vec3d& middle);
    // Both refuse, return false and do nothing, if a new triangle would lean more than kSteepest
    // away from the surface's `normal` at the edge. Merges b into a, moved to `to`; also refuses if
    // the surface would pinch or an edge become longer than `longest`.
    bool collapse(const Edge& e, const Vec3d& to, const Vec3d& normal, double longest);
    // Joins left and right instead of a and b; also refuses if they are joined already.
    bool flip(const Edge& e, const Vec3d& normal);
    // Would the narrower of the two triangles become wider?
    bool flip_widens(const Edge& e) const;

    static constexpr double kSteepest = 0.35; // cosine

  private:
    static constexpr std::uint32_t kGone = 0xffffffffu;

    std::uint32_t opposite(std::uint32_t a, std::uint32_t b, std::uint32_t& triangle) const;
    bool joined(std::uint32_t a, std::uint32_t b) const;
    std::size_t common_neighbours(std::uint32_t a, std::uint32_t b) const;
    bool collapse_folds(const Edge& e, std::uint32_t moved, const Vec3d& to, const Vec3d& normal,
                        double longest) const;
    void set_triangle(std::uint32_t t, const Triangle& corners);
    void add_triangle(const Triangle& corners);
    void remove_triangle(std::uint32_t t);

    std::vector<Vec3d> positions_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<std::uint32_t>> around_;
};

} // namespace mane
