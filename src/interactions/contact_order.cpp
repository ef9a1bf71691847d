#include "interactions/contact_order.h"

#include "base/sixteens.h"

#include <numeric>

namespace mane {

ContactOrder::ContactOrder(const Groom& groom, const Layout& layout)
    : section_(groom.section_count()), rank_(section_.size()), next_(section_.size(), kNone),
      before_(section_.size(), kNone), at_(layout.rows() * kLanes, kNone) {
    if (section_.empty())
        return;
    std::iota(section_.begin(), section_.end(), 0u);
    order_by_sixteens(groom.position, section_);
    for (std::uint32_t r = 0; r < size(); ++r)
        rank_[section_[r]] = r;
    for (std::uint32_t r = 0; r < size(); ++r) {
        const std::uint32_t s = section_[r];
        const Slot slot = layout.slot(s);
        at_[slot.row * kLanes + slot.lane] = r;
        if (s + 1 < groom.first_section[layout.wisp_of(s) + 1])
            before_[next_[r] = rank_[s + 1]] = r;
    }
}

} // namespace mane
