#pragma once

#include "mane/vec.h"

#include <cstdint>

namespace mane {

enum class ContactKind : std::uint8_t {
    friction,  ///< between quasi-parallel wisps, which slide into each other (§4.1)
    collision, ///< between wisps of different orientation (§4.1)
    sliding,   ///< with a polygon of a body (§4.2)
};
const char* contact_kind_name(ContactKind kind);

/// A contact that is engaged, and what it did in the last step.
struct Contact {
    static constexpr std::uint8_t kBetween = 255; ///< a point that is no section's own
    ContactKind kind = ContactKind::friction;
    std::uint8_t point = 0;    ///< 0: the skeleton point, 1 + k: envelope point k, or `kBetween`
    std::uint32_t section = 0; ///< of the point, an index of the groom; before it if between
    float along = 0;           ///< [1] of a point between: from its section to the next
    std::uint32_t other = 0;   ///< first section of the other wisp's segment; a body's triangle
    float other_along = 0;     ///< [1] place along the other wisp's segment
    std::uint32_t body = 0;    ///< with sliding contact: which body
    Vec3 impulse;              ///< [N·s] on the point; the other side got the opposite
};

/// A penetration reaction (§4.2, M32): a point that was inside a body and has been moved. Its
/// velocity stays as it was.
struct Reaction {
    std::uint32_t section = 0;  ///< of the point, an index of the groom
    std::uint8_t point = 0;     ///< 0: the skeleton point, 1 + k: envelope point k
    std::uint32_t body = 0;     ///< which body
    std::uint32_t triangle = 0; ///< the body's, nearest to where the point is now
    Vec3 shift;                 ///< [m] by which it was moved
};

} // namespace mane
