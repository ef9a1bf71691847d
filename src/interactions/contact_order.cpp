#include "interactions/contact_order.h"

#include "interactions/box.h"

#include <algorithm>
#include <numeric>

namespace mane {
namespace {

/// The bits of x with two zeros after each: a third of a place on Morton's curve.
std::uint64_t spread(std::uint32_t x) {
    std::uint64_t spread = 0;
    for (int bit = 0; bit < 20; ++bit)
        spread |= std::uint64_t{x >> bit & 1} << 3 * bit;
    return spread;
}

std::vector<std::uint64_t> places_on_curve(const std::vector<Vec3>& points) {
    Box all{points[0], points[0]};
    for (const Vec3& p : points)
        all.add(p);
    const Vec3 extent = all.high - all.low;
    const float scale = 1048575.f / std::max({extent.x, extent.y, extent.z, 1e-6f});
    const auto along = [scale](float x) { return spread(static_cast<std::uint32_t>(x * scale)); };
    std::vector<std::uint64_t> places;
    places.reserve(points.size());
    for (const Vec3& p : points)
        places.push_back(along(p.x - all.low.x) | along(p.y - all.low.y) << 1 |
                         along(p.z - all.low.z) << 2);
    return places;
}

} // namespace

ContactOrder::ContactOrder(const Groom& groom, const Layout& layout)
    : section_(groom.section_count()), rank_(section_.size()), next_(section_.size(), kNone),
      before_(section_.size(), kNone), at_(layout.rows() * kLanes, kNone) {
    if (section_.empty())
        return;
    const std::vector<std::uint64_t> place = places_on_curve(groom.position);
    std::iota(section_.begin(), section_.end(), 0u);
    std::stable_sort(section_.begin(), section_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return place[a] < place[b]; });
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
