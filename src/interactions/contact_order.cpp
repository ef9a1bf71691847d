#include "interactions/contact_order.h"

#include "interactions/box.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace mane {
namespace {

/// Cuts places along the longest side of the box that holds them, into halves that fill whole
/// nodes of a tree of sixteens, and those again, down to sixteen. Equal places stand in the order
/// of their numbers, so every library makes the same cuts (M39).
void cut(std::span<const Vec3> place, std::span<std::uint32_t> range) {
    if (range.size() <= kLanes) {
        std::sort(range.begin(), range.end());
        return;
    }
    Box box{place[range[0]], place[range[0]]};
    for (const std::uint32_t i : range)
        box.add(place[i]);
    const Vec3 size = box.high - box.low;
    float Vec3::*axis = size.x >= size.y && size.x >= size.z ? &Vec3::x
                        : size.y >= size.z                   ? &Vec3::y
                                                             : &Vec3::z;
    std::size_t part = kLanes;
    while (part * kLanes < range.size())
        part *= kLanes;
    const std::size_t parts = (range.size() + part - 1) / part, half = parts / 2 * part;
    std::nth_element(range.begin(), range.begin() + static_cast<std::ptrdiff_t>(half), range.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         return place[a].*axis != place[b].*axis ? place[a].*axis < place[b].*axis
                                                                 : a < b;
                     });
    cut(place, range.first(half));
    cut(place, range.subspan(half));
}

} // namespace

ContactOrder::ContactOrder(const Groom& groom, const Layout& layout)
    : section_(groom.section_count()), rank_(section_.size()), next_(section_.size(), kNone),
      before_(section_.size(), kNone), at_(layout.rows() * kLanes, kNone) {
    if (section_.empty())
        return;
    std::iota(section_.begin(), section_.end(), 0u);
    cut(groom.position, section_);
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
