#pragma once

#include "mane/frame.h"
#include "mane/groom.h"

#include <cstdint>
#include <vector>

namespace mane::judge {

/// Where a section stands in one frame (M7, M8).
struct Section {
    Vec3d x;       ///< [m] relative to the frame's origin
    Vec3d u, v, n; ///< its axes; n toward the tip
};

/// The hair of one frame in double precision: sections from the curves and first axes alone, by
/// turning quaternions, as M8 is worded.
class HairGeometry {
  public:
    HairGeometry(const Groom& groom, const Frame& frame);

    const Section& section(std::size_t s) const { return sections_[s]; }
    std::uint32_t points() const { return groom_->envelope_points; }
    double radius(std::size_t s, std::uint32_t k) const { return frame_->radius[s * points() + k]; }
    double largest_radius(std::size_t s) const;
    /// Half line k of a section in the world's axes, unit.
    Vec3d half_line(std::size_t s, std::uint32_t k) const;
    Vec3d envelope_point(std::size_t s, std::uint32_t k) const;

  private:
    const Groom* groom_;
    const Frame* frame_;
    std::vector<Section> sections_;
    std::vector<double> cosine_, sine_; // per half line
};

/// [m²] Area of section `s` with these radii (sections × K): elliptic sectors between neighbouring
/// half lines (M14a).
double section_area(const std::vector<float>& radii, std::size_t s, std::uint32_t points);

/// [J] Kinetic energy of section `s`: of its skeleton point and its envelope points.
double kinetic_energy(const Groom& groom, const Frame& frame, const HairGeometry& hair,
                      std::size_t s);

/// The wisp that a section belongs to.
std::uint32_t wisp_of(const Groom& groom, std::size_t section);

} // namespace mane::judge
