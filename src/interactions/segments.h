#pragma once

#include "base/aligned.h"
#include "interactions/box.h"
#include "interactions/point_test.h"
#include "model/state.h"

#include <span>
#include <vector>

namespace mane {

/// A section as contact sees it, in the order of the groom.
struct ContactSection {
    Vec3 x, u, v, normal;
    float area = 0;      ///< Σ r_k r_{k+1}: the section's area up to a constant factor
    float rest_area = 0; ///< the same in the design
};

/// All sections and simulated segments of the hair at one time, gathered from the packets once per
/// detection.
class ContactGeometry {
  public:
    void update(const HairView& hair);

    /// First sections of all simulated segments, in order, their volumes and boxes.
    std::span<const std::uint32_t> segments() const { return segments_; }
    const SegmentVolume& volume(std::size_t segment_index) const { return volumes_[segment_index]; }
    std::span<const Box> boxes() const { return boxes_; }
    /// Unit direction of a segment's axis, and its length in mean diameters.
    const Vec3& direction(std::size_t segment_index) const { return directions_[segment_index]; }
    float slenderness(std::size_t segment_index) const { return slenderness_[segment_index]; }
    std::size_t section_count() const { return sections_.size(); }
    const ContactSection& section(std::uint32_t s) const { return sections_[s]; }
    std::uint32_t segment_index(std::uint32_t section) const { return index_of_[section]; }

    /// The points that can be in contact, of all sections, and the boxes of each section's. Those
    /// of x₀, inside the head, are nowhere.
    SectionPoints points() const { return {x_.data(), y_.data(), z_.data(), k_ + 1}; }
    std::span<const Box> point_boxes() const { return point_boxes_; }

    /// The radius of a section in the direction of the section coordinates (a, b).
    float radius_toward(std::uint32_t section, float a, float b) const;
    /// Strand density at s of the segment, relative to rest.
    float density(std::uint32_t segment, float s) const;

  private:
    void lay_out(const HairView& hair);
    std::span<const float> radii(std::uint32_t section) const {
        return {radii_.data() + section * k_, k_};
    }
    void update_section(const HairView& hair, std::uint32_t section);
    void update_segment(std::size_t index);
    void update_points(std::uint32_t section);
    Box box_of(std::uint32_t segment) const;

    std::uint32_t k_ = 0;
    std::vector<HalfLine> half_lines_;
    std::vector<std::uint32_t> segments_, index_of_;
    std::vector<ContactSection> sections_;
    std::vector<float> radii_;
    std::vector<Vec3> directions_;
    std::vector<float> slenderness_;
    std::vector<SegmentVolume> volumes_;
    std::vector<Box> boxes_;
    AlignedVector<float> x_, y_, z_;
    std::vector<Box> point_boxes_;
    std::vector<std::uint8_t> inside_head_; ///< per section: x₀
};

} // namespace mane
