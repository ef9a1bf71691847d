#pragma once

#include "model/state.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace mane {

/// An axis-aligned box.
struct Box {
    Vec3 low, high;

    /// Grows to hold `p`.
    void add(const Vec3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    bool contains(const Vec3& p) const {
        return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y && low.z <= p.z &&
               p.z <= high.z;
    }
    bool overlaps(const Box& o) const {
        return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
               low.z <= o.high.z && o.low.z <= high.z;
    }
};

/// A section as contact sees it, in the order of the groom.
struct ContactSection {
    Vec3 x, u, v, normal;
    float area = 0;      ///< Σ r_k r_{k+1}: the section's area up to a constant factor
    float rest_area = 0; ///< the same in the design
};

/// Where a point lies in a segment's volume.
struct PlaceInSegment {
    float s = 0;     ///< along the segment, 0 to 1
    float depth = 0; ///< 0 on the skeleton, 1 on the envelope's surface
};

/// All sections and simulated segments of the hair at one time, gathered from the packets once per
/// detection.
class ContactGeometry {
  public:
    void update(const HairView& hair);

    std::uint32_t section_count() const { return static_cast<std::uint32_t>(sections_.size()); }
    /// First sections of all simulated segments, in order.
    std::span<const std::uint32_t> segments() const { return segments_; }
    const Box& box(std::size_t segment_index) const { return boxes_[segment_index]; }
    /// Unit direction of a segment's axis, and its length in mean diameters.
    const Vec3& direction(std::size_t segment_index) const { return directions_[segment_index]; }
    float slenderness(std::size_t segment_index) const { return slenderness_[segment_index]; }
    const ContactSection& section(std::uint32_t s) const { return sections_[s]; }
    std::span<const float> radii(std::uint32_t section) const {
        return {radii_.data() + section * k_, k_};
    }
    std::uint32_t envelope_points() const { return k_; }
    /// The points of a section that can be in contact: its skeleton point, then its K envelope
    /// points.
    std::span<const Vec3> points(std::uint32_t section) const {
        return {points_.data() + section * (k_ + 1), k_ + 1};
    }
    /// The box of these points.
    const Box& points_box(std::uint32_t section) const { return points_boxes_[section]; }

    /// Where `p` lies between the sections j and j+1 (M14a, M21); empty where it is not between
    /// their planes, or outside their box.
    std::optional<PlaceInSegment> place(std::size_t segment_index, const Vec3& p) const;
    /// The radius of a section in the direction of the section coordinates (a, b).
    float radius_toward(std::uint32_t section, float a, float b) const;
    /// Strand density at s of the segment, relative to rest.
    float density(std::uint32_t segment, float s) const;

  private:
    void find_segments(const HairView& hair);
    void update_section(const HairView& hair, std::uint32_t section);
    void update_segment(std::size_t index);
    Box box_of(std::uint32_t segment) const;

    std::uint32_t k_ = 0;
    std::vector<HalfLine> half_lines_;
    std::vector<std::uint32_t> segments_;
    std::vector<ContactSection> sections_;
    std::vector<float> radii_;
    std::vector<Vec3> points_, directions_;
    std::vector<float> slenderness_;
    std::vector<Box> points_boxes_, boxes_;
};

/// The square of the depth of section coordinates (a, b) in a section with these radii:
/// quarter-ellipses between neighbouring half lines, or their like for other K (M14a).
float squared_depth(std::span<const HalfLine> half_lines, std::span<const float> radii, float a,
                    float b);

} // namespace mane
