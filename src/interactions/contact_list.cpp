#include "interactions/contact_list.h"

#include <algorithm>

namespace mane {

void ContactList::clear() {
    std::fill(inside.begin(), inside.end(), std::span<const PointContact>());
    for (std::vector<PointContact>& chunk : found)
        chunk.clear();
    axes.clear();
}

std::size_t ContactList::size() const {
    std::size_t sum = axes.size();
    for (const std::vector<PointContact>& chunk : found)
        sum += chunk.size();
    return sum;
}

std::vector<WispContact> ContactList::all(const ContactOrder& order) const {
    std::vector<WispContact> contacts;
    contacts.reserve(size());
    for (std::uint32_t rank = 0; rank < inside.size(); ++rank)
        for (const PointContact& c : inside[rank])
            contacts.push_back({.section = order.section(c.rank()),
                                .point = {c.code()},
                                .kind = c.kind(),
                                .segment = order.section(rank),
                                .s = c.s,
                                .density = std::fabs(c.density),
                                .weight = c.weight});
    contacts.insert(contacts.end(), axes.begin(), axes.end());
    return contacts;
}

ContactList contact_list(const ContactOrder& order, std::span<const WispContact> contacts) {
    ContactList list;
    list.found.resize(order.size());
    for (const WispContact& c : contacts) {
        if (c.point.is_axis())
            list.axes.push_back(c);
        else
            list.found[order.rank(c.segment)].emplace_back(
                order.rank(c.section) * 16 + c.point.code, c.s, c.density, c.weight, c.kind);
    }
    list.inside.assign(list.found.begin(), list.found.end());
    return list;
}

} // namespace mane
