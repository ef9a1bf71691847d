#pragma once

/// §4.1, interactions between wisps: found by comparing everything with everything, answered one
/// contact after the other.

#include "mane/desc.h"
#include "reference/twin.h"

#include <compare>
#include <cstddef>
#include <optional>
#include <vector>

namespace mane::reference {

/// A section of the hair, or the segment that begins there.
struct Site {
    std::size_t wisp = 0, section = 0;
    auto operator<=>(const Site&) const = default;
};

/// A point of one wisp in a segment of another, or of its own.
struct Contact {
    static constexpr int kSkeleton = -1, kAxis = -2;
    Site point;        ///< its section; for a point on an axis, the segment
    int k = kSkeleton; ///< the envelope point, or one of the above
    double along = 0;  ///< place on the axis, 0 to 1
    Site segment;
    double s = 0;          ///< place along the segment, 0 to 1
    bool friction = false; ///< quasi-parallel: viscous friction; else a collision
    double density = 1;    ///< of strands at the place, relative to rest
    double weight = 1;     ///< how much it counts: little at the surface, 1 well inside
};

/// The frames of every wisp's sections.
using Frames = std::vector<std::vector<SectionFrame>>;
Frames all_frames(const Hair& hair);

// detection.cpp
struct PlaceInSegment {
    double s = 0;     ///< along the segment, 0 to 1
    double depth = 0; ///< 0 on the skeleton, 1 on the envelope's surface
};
/// Where p lies in the volume between sections `segment` and `segment` + 1; empty where it is not
/// between their planes.
std::optional<PlaceInSegment> place_in_segment(const Wisp& wisp,
                                               const std::vector<SectionFrame>& frames,
                                               std::size_t segment, const Vec3d& p);
/// Depth of a d_0-axis, b second-axis point in a section with these radii.
double depth_in_section(const Ring& radii, double a, double b);

struct Detection {
    std::vector<Contact> contacts;      ///< by point (skeleton, envelope, axis), then by segment
    std::size_t intersecting_pairs = 0; ///< of segments, one with a point in the other
};
/// All contacts. `earlier`: those of the detection before, for the hysteresis of M23.
Detection detect(const Hair& hair, const WispContactDesc& desc,
                 const std::vector<Contact>& earlier = {});

// contact_kind.cpp
/// One side of a contact: the direction of its wisp there, and its velocity.
struct Side {
    Vec3d direction, velocity;
};
Side point_side(const Hair& hair, const Frames& frames, const Contact& contact);
Side segment_side(const Hair& hair, const Contact& contact);
/// M23: whether the two sides slide along each other. A contact that did so before stays within
/// wider limits.
bool quasi_parallel(const Side& p, const Side& s, const WispContactDesc& desc, bool before);

// interactions.cpp
/// Velocity modifications for the given contacts (M24–M28). `friction_time` [s]: how long
/// quasi-parallel contacts act; 0 leaves them out. With `desc.literal`, the rule as printed.
void respond(Hair& hair, const std::vector<Contact>& contacts, const WispContactDesc& desc,
             double friction_time);

} // namespace mane::reference
