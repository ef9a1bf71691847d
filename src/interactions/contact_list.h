#pragma once

#include "interactions/contact_order.h"
#include "interactions/wisp_contact.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// Contacts of points, segment by segment in the order of ranks, then contacts of axes.
struct ContactList {
    std::vector<WispContact> contacts;
    /// Per rank, and one more: where those of the segment that begins there begin.
    std::vector<std::uint32_t> first;

    std::span<const WispContact> of_segment(std::uint32_t rank) const {
        return std::span(contacts).subspan(first[rank], first[rank + 1] - first[rank]);
    }
    std::size_t of_points() const { return first.empty() ? 0 : first.back(); }
    std::span<const WispContact> axes() const { return std::span(contacts).subspan(of_points()); }
};

/// A list of contacts that come in any order; those of a segment keep it.
ContactList contact_list(const ContactOrder& order, std::span<const WispContact> contacts);

} // namespace mane
