#include "character/polygonise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace mane {
namespace {

// The six tetrahedra around a cube's diagonal 0–7: corner bits x = 1, y = 2, z = 4. Neighbouring
// cubes cut their shared face alike.
constexpr int kTetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                   {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

class Grid {
  public:
    Grid(double (*distance)(const Vec3d&), const Box& box, double cell)
        : low_(box.low), cell_(cell) {
        const Vec3d extent = box.high - box.low;
        for (int a = 0; a < 3; ++a) {
            const double length = a == 0 ? extent.x : a == 1 ? extent.y : extent.z;
            size_[a] = static_cast<std::size_t>(std::floor(length / cell)) + 2;
        }
        values_.reserve(size_[0] * size_[1] * size_[2]);
        for (std::size_t row = 0; row < size_[1] * size_[2]; ++row)
            fill_row(distance);
    }

    Mesh polygonise() {
        for (std::size_t z = 0; z + 1 < size_[2]; ++z)
            for (std::size_t y = 0; y + 1 < size_[1]; ++y)
                for (std::size_t x = 0; x + 1 < size_[0]; ++x)
                    cut_cube(node(x, y, z));
        return std::move(mesh_);
    }

  private:
    // Far from the surface only the sign matters: it holds for as many nodes as the distance spans,
    // halved because smooth unions and ellipsoids are no exact distances.
    void fill_row(double (*distance)(const Vec3d&)) {
        for (std::size_t x = 0; x < size_[0];) {
            const double value = distance(position(values_.size()));
            const auto same = static_cast<std::size_t>(std::fabs(value) / (2 * cell_)) + 1;
            const std::size_t end = std::min(size_[0], x + same);
            for (; x < end; ++x)
                values_.push_back(value);
        }
    }

    std::size_t node(std::size_t x, std::size_t y, std::size_t z) const {
        return x + size_[0] * (y + size_[1] * z);
    }
    Vec3d position(std::size_t n) const {
        const std::size_t x = n % size_[0], y = n / size_[0] % size_[1],
                          z = n / size_[0] / size_[1];
        return low_ + Vec3d(double(x), double(y), double(z)) * cell_;
    }
    bool inside(std::size_t n) const { return values_[n] < 0; }

    void cut_cube(std::size_t corner) {
        std::size_t corners[8];
        for (std::size_t k = 0; k < 8; ++k)
            corners[k] = corner + node(k & 1, k >> 1 & 1, k >> 2 & 1);
        for (const auto& t : kTetrahedra)
            cut_tetrahedron({corners[t[0]], corners[t[1]], corners[t[2]], corners[t[3]]});
    }

    // Corners are brought to the front, inside ones first, by an even permutation, so that the
    // orientation stays.
    void cut_tetrahedron(std::array<std::size_t, 4> n) {
        const auto count =
            std::count_if(n.begin(), n.end(), [&](std::size_t c) { return inside(c); });
        if (count == 0 || count == 4)
            return;
        if (count == 2) {
            const std::size_t first = std::size_t(
                std::find_if(n.begin(), n.end(), [&](std::size_t c) { return inside(c); }) -
                n.begin());
            rotate_to_front(n, first);
            while (!inside(n[1]))
                std::rotate(n.begin() + 1, n.begin() + 2, n.end());
            const auto a = cut(n[0], n[2]), b = cut(n[0], n[3]), c = cut(n[1], n[3]),
                       d = cut(n[1], n[2]);
            mesh_.triangles.push_back({a, b, c});
            mesh_.triangles.push_back({a, c, d});
            return;
        }
        const bool single_inside = count == 1;
        const std::size_t single =
            std::size_t(std::find_if(n.begin(), n.end(),
                                     [&](std::size_t c) { return inside(c) == single_inside; }) -
                        n.begin());
        rotate_to_front(n, single);
        const auto a = cut(n[0], n[1]), b = cut(n[0], n[2]), c = cut(n[0], n[3]);
        if (single_inside)
            mesh_.triangles.push_back({a, b, c});
        else
            mesh_.triangles.push_back({a, c, b});
    }
    static void rotate_to_front(std::array<std::size_t, 4>& n, std::size_t k) {
        if (k == 0)
            return;
        std::swap(n[0], n[k]);
        std::swap(n[k == 1 ? 2 : 1], n[k == 3 ? 2 : 3]); // a second swap, of the two that stayed
    }

    // The vertex on the edge between an inside and an outside node.
    std::uint32_t cut(std::size_t a, std::size_t b) {
        const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [entry, is_new] = cuts_.try_emplace(key, std::uint32_t(mesh_.vertices.size()));
        if (is_new) {
            const double s = values_[a] / (values_[a] - values_[b]);
            mesh_.vertices.push_back(Vec3(position(a) * (1 - s) + position(b) * s));
        }
        return entry->second;
    }

    Vec3d low_;
    double cell_;
    std::size_t size_[3];
    std::vector<double> values_;
    std::unordered_map<std::uint64_t, std::uint32_t>
        cuts_; // looked up only, never walked: its order reaches nothing
    Mesh mesh_;
};

} // namespace

Mesh polygonise(double (*distance)(const Vec3d&), const Box& box, double cell) {
    return Grid(distance, box, cell).polygonise();
}

} // namespace mane
