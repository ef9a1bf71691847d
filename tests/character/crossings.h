#pragma once

#include "mane/body.h"

#include <algorithm>
#include <numeric>
#include <vector>

/// Pairs of triangles that share no vertex and pass through each other, by brute force over those
/// whose boxes overlap.
class Crossings {
  public:
    Crossings(const mane::Mesh& mesh, const std::vector<mane::Vec3>& positions)
        : mesh_(mesh), positions_(positions) {}

    std::size_t count() const {
        std::vector<std::size_t> order(mesh_.triangles.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::vector<Box> boxes;
        for (std::size_t t = 0; t < order.size(); ++t)
            boxes.push_back(box(t));
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return boxes[a].low.x < boxes[b].low.x;
        });
        std::size_t crossings = 0;
        for (std::size_t i = 0; i < order.size(); ++i)
            for (std::size_t j = i + 1;
                 j < order.size() && boxes[order[j]].low.x <= boxes[order[i]].high.x; ++j)
                if (overlap(boxes[order[i]], boxes[order[j]]) && !neighbours(order[i], order[j]))
                    crossings += pierces(order[i], order[j]) || pierces(order[j], order[i]);
        return crossings;
    }

  private:
    using V = mane::Vec3d;
    struct Box {
        V low, high;
    };
    V corner(std::size_t t, std::size_t k) const { return V(positions_[mesh_.triangles[t][k]]); }
    Box box(std::size_t t) const {
        Box b{corner(t, 0), corner(t, 0)};
        for (std::size_t k = 1; k < 3; ++k) {
            const V p = corner(t, k);
            b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
            b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
        }
        return b;
    }
    static bool overlap(const Box& a, const Box& b) {
        return a.low.y <= b.high.y && b.low.y <= a.high.y && a.low.z <= b.high.z &&
               b.low.z <= a.high.z;
    }
    bool neighbours(std::size_t s, std::size_t t) const {
        for (auto a : mesh_.triangles[s])
            for (auto b : mesh_.triangles[t])
                if (a == b)
                    return true;
        return false;
    }
    static double volume(const V& a, const V& b, const V& c, const V& d) {
        return dot(cross(b - a, c - a), d - a);
    }
    // Does an edge of s pass through t? Its ends lie on both sides of t's plane, and it turns the
    // same way around all of t's edges.
    bool pierces(std::size_t s, std::size_t t) const {
        const V a = corner(t, 0), b = corner(t, 1), c = corner(t, 2);
        for (std::size_t k = 0; k < 3; ++k) {
            const V p = corner(s, k), q = corner(s, (k + 1) % 3);
            if (volume(a, b, c, p) * volume(a, b, c, q) >= 0)
                continue;
            const double u = volume(p, q, a, b), v = volume(p, q, b, c), w = volume(p, q, c, a);
            if ((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))
                return true;
        }
        return false;
    }

    const mane::Mesh& mesh_;
    const std::vector<mane::Vec3>& positions_;
};
