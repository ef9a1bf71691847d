#pragma once

#include "check/hair_geometry.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mane::judge {

/// Finds segments that intersect (M21): a skeleton or envelope point of one inside the volume of
/// the other. Every pair whose boxes overlap is tested, by order along one axis and nothing else.
class Overlaps {
  public:
    Overlaps(const Groom& groom, const HairGeometry& hair);

    /// Per simulated segment, in order, the number of other segments that it intersects.
    const std::vector<std::uint32_t>& count() const { return count_; }
    /// Pairs that intersect, by their numbers in `segments()`.
    const std::vector<std::array<std::uint32_t, 2>>& pairs() const { return pairs_; }
    /// First sections of the simulated segments.
    const std::vector<std::uint32_t>& segments() const { return segments_; }

  private:
    struct Box {
        Vec3d low, high;
    };

    Box box_of(std::size_t segment) const;
    bool share_section(std::uint32_t a, std::uint32_t b) const;
    bool any_point_inside(std::uint32_t a, std::size_t b_index) const;
    bool inside(const Vec3d& p, std::size_t segment_index) const;
    double depth(double a, double b, std::uint32_t segment, double s) const;

    const Groom& groom_;
    const HairGeometry& hair_;
    std::vector<std::uint32_t> segments_;
    std::vector<Box> boxes_;
    std::vector<Vec3d> points_; // sections × (K + 1): the skeleton point, then the envelope points
    std::vector<std::uint32_t> count_;
    std::vector<std::array<std::uint32_t, 2>> pairs_;
};

} // namespace mane::judge
