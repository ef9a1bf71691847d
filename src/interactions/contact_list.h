#pragma once

#include "interactions/contact_order.h"
#include "interactions/wisp_contact.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// A point of the hair in the volume of a segment, as it is kept: of all that is stored of contacts
/// this is the most.
struct PointContact {
    std::uint32_t point = 0; ///< rank of its section · 16 + code
    float s = 0;             ///< place along the segment, 0 to 1
    float density = 0;       ///< of strands there, relative to rest; with a minus if wisps collide
    float weight = 0;        ///< how much it counts, 0 at the surface to 1 well inside

    PointContact() = default;
    PointContact(std::uint32_t p, float along, float d, float w, WispContactKind kind)
        : point(p), s(along), density(kind == WispContactKind::friction ? d : -d), weight(w) {}

    std::uint32_t rank() const { return point / 16; }
    std::uint8_t code() const { return static_cast<std::uint8_t>(point % 16); }
    WispContactKind kind() const {
        return std::signbit(density) ? WispContactKind::collision : WispContactKind::friction;
    }
};

/// The contacts of a detection. It is moved, not copied: what is inside segments points to what was
/// found.
struct ContactList {
    std::vector<std::vector<PointContact>> found; ///< chunk by chunk of segments
    /// Per rank: in the segment that begins there, a part of what was found.
    std::vector<std::span<const PointContact>> inside;
    std::vector<WispContact> axes;

    ContactList() = default;
    ContactList(ContactList&&) = default;
    ContactList& operator=(ContactList&&) = default;

    /// Nothing in any of the segments.
    void clear();
    std::size_t size() const;
    /// All of them, segment by segment in the order of ranks, then those of axes.
    std::vector<WispContact> all(const ContactOrder& order) const;
};

/// A list of contacts that come in any order; those of a segment keep it.
ContactList contact_list(const ContactOrder& order, std::span<const WispContact> contacts);

} // namespace mane
