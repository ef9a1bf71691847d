#pragma once

#include "groom/comb.h"
#include "groom/roots.h"
#include "groom/solid.h"
#include "mane/style.h"

#include <vector>

namespace mane {

/// Half width of a wisp at `s`, 0 at x₁ and 1 at the tip [m].
double wisp_radius(const StyleDesc& style, double s);

/// The middle lines of wisps: points [m] every few millimetres from x₁ to the tip, off the body by
/// part of the wisp's depth.
class Grower {
  public:
    Grower(const StyleDesc& style, const ScalpExtent& extent, const Solid& body)
        : style_(style), extent_(extent), comb_(style, extent), body_(body) {}

    /// A line `length` [m] long. `turn` [rad] turns it at its root, about the scalp's normal.
    std::vector<Vec3d> grow(const ScalpPoint& root, double length, double turn) const;

    const Comb& comb() const { return comb_; }

  private:
    Vec3d root_direction(const ScalpPoint& root, double turn) const;
    double stand_off(const ScalpPoint& root, double way, double length) const;
    std::vector<Vec3d> walk(const ScalpPoint& root, double length, double turn) const;
    void smooth(std::vector<Vec3d>& line, const ScalpPoint& root, double length) const;

    const StyleDesc& style_;
    ScalpExtent extent_;
    Comb comb_;
    const Solid& body_;
};

} // namespace mane
