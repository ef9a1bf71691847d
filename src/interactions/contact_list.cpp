#include "interactions/contact_list.h"

#include "base/bins.h"

namespace mane {

ContactList contact_list(const ContactOrder& order, std::span<const WispContact> contacts) {
    const std::uint32_t ranks = order.size();
    const auto bin = [&](const WispContact& c) {
        return c.point.is_axis() ? ranks : order.rank(c.segment);
    };
    Bins bins;
    bins.start(std::size_t{ranks} + 1);
    for (const WispContact& c : contacts)
        bins.count(bin(c));
    ContactList list;
    list.contacts.resize(bins.add_up());
    for (const WispContact& c : contacts)
        list.contacts[bins.next(bin(c))] = c;
    bins.finish();
    for (std::uint32_t r = 0; r <= ranks; ++r)
        list.first.push_back(bins.first(r));
    return list;
}

} // namespace mane
