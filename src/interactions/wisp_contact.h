#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace mane {

/// What two wisps in contact do to each other (§4.1).
enum class WispContactKind : std::uint8_t {
    friction,  ///< quasi-parallel: they slide into each other with viscous friction
    collision, ///< different orientations: they collide and dissipate
};

/// Which point of a section is in contact: the skeleton point, an envelope point, or a point on the
/// axis of the segment that begins at the section (axis contacts of long segments, M21).
struct ContactPoint {
    static constexpr std::uint8_t kSkeleton = 0;
    static constexpr std::uint8_t kAxis = 255;
    std::uint8_t code = kSkeleton;

    static constexpr ContactPoint envelope(std::uint32_t k) {
        return {static_cast<std::uint8_t>(k + 1)};
    }
    constexpr bool is_envelope() const { return code != kSkeleton && code != kAxis; }
    constexpr bool is_axis() const { return code == kAxis; }
    constexpr std::uint32_t k() const { return code - 1u; }
    auto operator<=>(const ContactPoint&) const = default;
};

/// A point of one wisp inside a segment of another, or of its own. Section indices are the groom's.
struct WispContact {
    std::uint32_t section = 0; ///< of the point
    ContactPoint point;
    WispContactKind kind = WispContactKind::collision;
    std::uint32_t segment = 0; ///< first section of the segment
    float s = 0;               ///< place along the segment, 0 to 1
    float along = 0;           ///< axis contacts: place along the point's own segment, 0 to 1
    float density = 1;         ///< strand density in the segment there, relative to rest
    float weight = 1;          ///< how much it counts, 0 at the surface to 1 well inside
};

/// The order in which contacts are kept: nothing depends on how they were found.
constexpr bool same_place(const WispContact& a, const WispContact& b) {
    return a.section == b.section && a.point == b.point && a.segment == b.segment;
}
constexpr bool before(const WispContact& a, const WispContact& b) {
    if (a.section != b.section)
        return a.section < b.section;
    if (a.point != b.point)
        return a.point < b.point;
    return a.segment < b.segment;
}

} // namespace mane
