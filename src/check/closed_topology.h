#pragma once

#include "mane/body.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mane::judge {

/// A body's triangles without a border, so that its inside is defined. Where an open mesh ends, a
/// cone over each connected part of the border closes it, with its apex at the mean of that part.
class ClosedTopology {
  public:
    explicit ClosedTopology(const Mesh& mesh);

    /// Corners are indices into what `positions` returns.
    const std::vector<std::array<std::uint32_t, 3>>& triangles() const { return triangles_; }
    /// The posed vertices and, behind them, the apexes.
    std::vector<Vec3d> positions(std::span<const Vec3> vertices) const;

  private:
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    std::vector<std::vector<std::uint32_t>> borders_; // per apex
};

} // namespace mane::judge
