#pragma once

#include "groom/roots.h"
#include "mane/style.h"

#include <span>

namespace mane {

/// The scalp's extent, by which "front", "crown" and "nape" are known on any head.
struct ScalpExtent {
    Vec3d low, high; ///< [m]
    /// 0 at the lowest (rearmost) root, 1 at the highest (foremost).
    double height(double y) const { return (y - low.y) / (high.y - low.y); }
    double front(double z) const { return (z - low.z) / (high.z - low.z); }
};
ScalpExtent scalp_extent(const Mesh& mesh, std::span<const std::uint32_t> scalp);

/// Which way hair wants to go.
class Comb {
  public:
    Comb(const StyleDesc& style, const ScalpExtent& extent) : style_(style), extent_(extent) {}

    /// The direction, not unit, that hair rooted at `root` is combed to at `p`, where the body's
    /// outward direction is `outward`.
    Vec3d direction(const Vec3d& root, const Vec3d& p, const Vec3d& outward, double lying) const;

    /// Whether nothing grows there because hair is parted.
    bool on_parting(const ScalpPoint& p) const;

  private:
    double side(const Vec3d& root) const;
    Vec3d over_shoulder(const Vec3d& root, const Vec3d& p, const Vec3d& outward,
                        double lying) const;

    const StyleDesc& style_;
    ScalpExtent extent_;
};

} // namespace mane
