#pragma once

#include "mane/curves.h"
#include "mane/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// A box along the axes; empty at first.
struct Box {
    Vec3 low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
    void enclose(std::span<const Vec3> points);
};

/// Numbers on the nodes of a regular grid around a box.
class Volume {
  public:
    Volume(const Box& box, float cell);

    /// Adds `amount` around `p`, shared among the eight nodes.
    void splat(const Vec3& p, float amount);
    /// The value at `p`, linear between nodes; that of the nearest border outside.
    float at(const Vec3& p) const;

    float cell() const { return cell_; }
    const std::array<int, 3>& size() const { return size_; }
    std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(size_[0]) *
                   (static_cast<std::size_t>(y) +
                    static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(z));
    }
    std::vector<float>& values() { return values_; }
    const std::vector<float>& values() const { return values_; }

  private:
    struct Corner {
        std::array<int, 3> node;
        std::array<float, 3> share;
    };
    Corner corner(const Vec3& p) const;

    Vec3 low_;
    float cell_;
    std::array<int, 3> size_;
    std::vector<float> values_;
};

/// Adds the strands' optical depth per length [1/m]: their shadowing width per volume, times
/// `width_scale`.
void add_strands(const Curves& strands, float width_scale, Volume& density);

/// Adds a body's surface as a shell, a cell or two thick, of optical depth `depth` across.
void add_surface(std::span<const Vec3> vertices,
                 std::span<const std::array<std::uint32_t, 3>> triangles, float depth,
                 Volume& density);

/// Optical depth from every node toward a light in direction `light`: one sweep from the light's
/// side. Each layer is read between nodes of the one before, which blurs shadows with distance as a
/// soft light does. In place of a shadow ray per strand: those cost ten times as much, and need
/// many samples to be soft.
Volume swept_depth(const Volume& density, const Vec3& light);

/// The share of a sky that every node sees through the hair, `sky(direction)` over the directions
/// that are swept.
struct SkyDirection {
    Vec3 direction;
    float weight; ///< sum 1
};
/// The share of the sky that every node sees.
Volume visible_sky(const Volume& density, std::span<const SkyDirection> sky);

} // namespace mane
