#pragma once

/// What the core has found, as the twin reads it.

#include "interactions/character_contact.h"
#include "interactions/wisp_contact.h"
#include "model/layout.h"
#include "reference/character.h"
#include "reference/interactions.h"

#include <span>
#include <vector>

namespace mane {

/// Contacts between wisps.
inline std::vector<reference::Contact> contacts_of(std::span<const WispContact> contacts,
                                                   const Groom& groom, const Layout& layout) {
    const auto site = [&](std::uint32_t section) {
        const std::uint32_t w = layout.wisp_of(section);
        return reference::Site{w, section - groom.first_section[w]};
    };
    std::vector<reference::Contact> taken;
    for (const WispContact& c : contacts) {
        reference::Contact contact;
        contact.point = site(c.section);
        if (c.point.is_axis())
            contact.k = reference::Contact::kAxis;
        else if (c.point.is_envelope())
            contact.k = static_cast<int>(c.point.k());
        contact.along = double{c.along};
        contact.segment = site(c.segment);
        contact.s = double{c.s};
        contact.friction = c.kind == WispContactKind::friction;
        contact.density = double{c.density};
        contact.weight = double{c.weight};
        taken.push_back(contact);
    }
    return taken;
}

/// The planes of a wisp's sliding contacts, as they are after `fraction` of a block of `seconds`.
inline std::vector<reference::SlidingPlane> planes_of(std::span<const SlidingContact> contacts,
                                                      double fraction, double seconds) {
    std::vector<reference::SlidingPlane> planes;
    for (const SlidingContact& c : contacts) {
        reference::SlidingPlane plane;
        plane.point = {c.point.section, double{c.point.along}, c.point.k, double{c.point.alpha},
                       double{c.point.beta}};
        plane.anchor = Vec3d(c.anchor) + fraction * Vec3d(c.anchor_change);
        plane.anchor_velocity = Vec3d(c.anchor_change) / seconds;
        plane.normal = Vec3d(c.normal) + fraction * Vec3d(c.normal_change);
        plane.normal_rate = Vec3d(c.normal_change) / seconds;
        plane.threshold = double{c.threshold};
        planes.push_back(plane);
    }
    return planes;
}

} // namespace mane
