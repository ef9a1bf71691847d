#pragma once

/// The core's side of every comparison with the twin: the same hair, in packets.

#include "interactions/wisp_contact.h"
#include "model/state.h"
#include "reference/interactions.h"

#include <cstdint>
#include <vector>

namespace mane {

struct CoreHair {
    Groom groom;
    Layout layout;
    RestRows rest;
    std::vector<HalfLine> lines;
    State state;
    SectionFrames frames;

    explicit CoreHair(const Groom& g)
        : groom(g), layout(groom), rest(groom, layout), lines(half_lines(groom.envelope_points)),
          state(layout.rows(), groom.envelope_points), frames(layout.rows()) {}

    HairView view() const { return {groom, layout, rest, state, frames, lines}; }

    Slot slot(std::size_t wisp, std::size_t section) const {
        return layout.slot(groom.first_section[wisp] + static_cast<std::uint32_t>(section));
    }

    void take(const Frame& frame) {
        const std::uint32_t k = groom.envelope_points;
        for (std::uint32_t s = 0; s < groom.section_count(); ++s) {
            const Slot at = layout.slot(s);
            state.position.set(at, frame.position[s]);
            state.velocity.set(at, frame.velocity[s]);
            for (std::uint32_t e = 0; e < k; ++e) {
                state.radius.at(at, e) = frame.radius[s * k + e];
                state.radius_rate.at(at, e) = frame.radius_rate[s * k + e];
            }
        }
    }

    void take(const reference::Frames& axes) {
        for (std::size_t w = 0; w < axes.size(); ++w)
            for (std::size_t i = 0; i < axes[w].size(); ++i) {
                frames.u.set(slot(w, i), Vec3(axes[w][i].u));
                frames.v.set(slot(w, i), Vec3(axes[w][i].v));
                frames.normal.set(slot(w, i), Vec3(axes[w][i].n));
            }
    }

    std::uint32_t section(const reference::Site& site) const {
        return groom.first_section[site.wisp] + static_cast<std::uint32_t>(site.section);
    }

    std::vector<WispContact> take(const std::vector<reference::Contact>& contacts) const {
        std::vector<WispContact> taken;
        for (const reference::Contact& c : contacts) {
            WispContact contact;
            contact.section = section(c.point);
            if (c.k == reference::Contact::kAxis)
                contact.point = {ContactPoint::kAxis};
            else if (c.k >= 0)
                contact.point = ContactPoint::envelope(static_cast<std::uint32_t>(c.k));
            contact.kind = c.friction ? WispContactKind::friction : WispContactKind::collision;
            contact.segment = section(c.segment);
            contact.s = static_cast<float>(c.s);
            contact.along = static_cast<float>(c.along);
            contact.density = static_cast<float>(c.density);
            contact.weight = static_cast<float>(c.weight);
            taken.push_back(contact);
        }
        return taken;
    }
};

} // namespace mane
