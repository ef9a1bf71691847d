#include "picture/shadow_volume.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr float kMeanSine =
    0.785f; // of the angle between strand and light, over all directions: π/4

float component(const Vec3& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

} // namespace

void Box::enclose(std::span<const Vec3> points) {
    for (const Vec3& p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
}

Volume::Volume(const Box& box, float cell) : cell_(cell) {
    const float margin = 2 * cell;
    low_ = box.low - Vec3{margin, margin, margin};
    for (int a = 0; a < 3; ++a)
        size_[a] =
            2 + static_cast<int>(
                    std::max(component(box.high, a) + margin - component(low_, a), margin) / cell);
    values_.resize(index(0, 0, size_[2]));
}

Volume::Corner Volume::corner(const Vec3& p) const {
    Corner c;
    for (int a = 0; a < 3; ++a) {
        const float x = std::clamp((component(p, a) - component(low_, a)) / cell_, 0.0f,
                                   static_cast<float>(size_[a] - 1) - 1e-3f);
        c.node[a] = static_cast<int>(x);
        c.share[a] = x - static_cast<float>(c.node[a]);
    }
    return c;
}

void Volume::splat(const Vec3& p, float amount) {
    const Corner c = corner(p);
    for (int i = 0; i < 8; ++i) {
        const int dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
        const float share = (dx ? c.share[0] : 1 - c.share[0]) *
                            (dy ? c.share[1] : 1 - c.share[1]) * (dz ? c.share[2] : 1 - c.share[2]);
        values_[index(c.node[0] + dx, c.node[1] + dy, c.node[2] + dz)] += amount * share;
    }
}

float Volume::at(const Vec3& p) const {
    const Corner c = corner(p);
    const float* v = values_.data() + index(c.node[0], c.node[1], c.node[2]);
    const std::size_t y = index(0, 1, 0), z = index(0, 0, 1);
    const auto along_x = [&](std::size_t o) { return v[o] + (v[o + 1] - v[o]) * c.share[0]; };
    const float near = along_x(0) + (along_x(y) - along_x(0)) * c.share[1];
    const float far = along_x(z) + (along_x(z + y) - along_x(z)) * c.share[1];
    return near + (far - near) * c.share[2];
}

void add_strands(const Curves& strands, float width_scale, Volume& density) {
    const float cell = density.cell(), per_volume = kMeanSine * width_scale / (cell * cell * cell);
    for (std::size_t s = 0; s + 1 < strands.first_vertex.size(); ++s)
        for (std::uint32_t v = strands.first_vertex[s]; v + 1 < strands.first_vertex[s + 1]; ++v) {
            const Vec3 a = strands.position[v], b = strands.position[v + 1];
            const float along = length(b - a),
                        area = along * 0.5f * (strands.width[v] + strands.width[v + 1]);
            const int pieces = 1 + static_cast<int>(along / cell);
            for (int i = 0; i < pieces; ++i)
                density.splat(a + (b - a) *
                                      ((static_cast<float>(i) + 0.5f) / static_cast<float>(pieces)),
                              area * per_volume / static_cast<float>(pieces));
        }
}

void add_surface(std::span<const Vec3> vertices,
                 std::span<const std::array<std::uint32_t, 3>> triangles, float depth,
                 Volume& density) {
    const float cell = density.cell();
    for (const auto& [a, b, c] : triangles) {
        const Vec3 p = vertices[a], ab = vertices[b] - p, ac = vertices[c] - p;
        const float longest = std::max({length(ab), length(ac), length(ac - ab)});
        const int rows = 1 + static_cast<int>(longest / cell);
        const float n = static_cast<float>(rows);
        const float amount = 0.5f * length(cross(ab, ac)) / (n * n) * depth / (cell * cell * cell);
        // Centres of the rows² small triangles that the triangle divides into, upright and
        // upside-down ones.
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < 2 * (rows - i) - 1; ++j) {
                const int column = j / 2;
                const float third = j % 2 ? 2.0f / 3 : 1.0f / 3;
                density.splat(p + ab * ((static_cast<float>(i) + third) / n) +
                                  ac * ((static_cast<float>(column) + third) / n),
                              amount);
            }
    }
}

Volume swept_depth(const Volume& density, const Vec3& light) {
    Volume depth = density;
    std::fill(depth.values().begin(), depth.values().end(), 0.0f);
    int main = 0;
    for (int a = 1; a < 3; ++a)
        if (std::abs(component(light, a)) > std::abs(component(light, main)))
            main = a;
    const int u = (main + 1) % 3, v = (main + 2) % 3;
    const float steepness = 1 / std::abs(component(light, main));
    const float du = component(light, u) * steepness, dv = component(light, v) * steepness;
    const std::array<int, 3> n = density.size();
    const std::array<std::size_t, 3> stride{1, density.index(0, 1, 0), density.index(0, 0, 1)};
    const bool descending = component(light, main) > 0; // the light's side is the high one
    const float half_step = 0.5f * steepness * density.cell();

    const std::vector<float>& in = density.values();
    std::vector<float>& out = depth.values();
    for (int layer = 1; layer < n[main]; ++layer) {
        const auto here =
            static_cast<std::size_t>(descending ? n[main] - 1 - layer : layer) * stride[main];
        const auto before =
            static_cast<std::size_t>(descending ? n[main] - layer : layer - 1) * stride[main];
        for (int j = 0; j < n[v]; ++j) {
            const float y = static_cast<float>(j) + dv;
            if (y < 0 || y >= static_cast<float>(n[v] - 1))
                continue; // lit from outside the grid
            const int y0 = static_cast<int>(y);
            const float ty = y - static_cast<float>(y0);
            const std::size_t row = before + static_cast<std::size_t>(y0) * stride[v];
            for (int i = 0; i < n[u]; ++i) {
                const float x = static_cast<float>(i) + du;
                if (x < 0 || x >= static_cast<float>(n[u] - 1))
                    continue;
                const int x0 = static_cast<int>(x);
                const float tx = x - static_cast<float>(x0);
                const std::size_t from = row + static_cast<std::size_t>(x0) * stride[u];
                const auto between = [&](const std::vector<float>& f) {
                    const float a = f[from] + (f[from + stride[u]] - f[from]) * tx;
                    const float b = f[from + stride[v]] +
                                    (f[from + stride[v] + stride[u]] - f[from + stride[v]]) * tx;
                    return a + (b - a) * ty;
                };
                const std::size_t to = here + static_cast<std::size_t>(i) * stride[u] +
                                       static_cast<std::size_t>(j) * stride[v];
                out[to] = between(out) + half_step * (between(in) + in[to]);
            }
        }
    }
    return depth;
}

Volume visible_sky(const Volume& density, std::span<const SkyDirection> sky) {
    Volume visible = density;
    std::fill(visible.values().begin(), visible.values().end(), 0.0f);
    for (const SkyDirection& s : sky) {
        const Volume depth = swept_depth(density, s.direction);
        for (std::size_t i = 0; i < visible.values().size(); ++i)
            visible.values()[i] += s.weight * std::exp(-depth.values()[i]);
    }
    return visible;
}

} // namespace mane
