#pragma once

#include "base/bins.h"
#include "mane/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// Points in cells, to ask for the nearest one.
class NearestPoint {
  public:
    explicit NearestPoint(std::span<const Vec3d> points);
    /// The nearest point to `p`; of equally near ones the lowest.
    std::size_t operator()(const Vec3d& p) const;

  private:
    struct Cell {
        long x, y, z;
    };
    Cell cell_of(const Vec3d& p) const;
    template <typename Visit> void for_shell(const Cell& middle, long away, Visit&& visit) const;

    std::vector<Vec3d> points_;
    Vec3d low_;
    double size_ = 1;
    long count_[3] = {1, 1, 1};
    Bins cells_;
    std::vector<std::uint32_t> order_; ///< points, cell after cell
};

} // namespace mane
