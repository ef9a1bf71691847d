#include "model/layout.h"

#include "base/sixteens.h"

#include <algorithm>
#include <numeric>

namespace mane {
namespace {

/// The longest first; of equally long ones, those that lie together in the design together.
std::vector<std::uint32_t> in_packets(const Groom& groom) {
    std::vector<std::uint32_t> order(groom.wisp_count());
    std::vector<Vec3> middle;
    for (std::uint32_t w = 0; w < order.size(); ++w)
        middle.push_back(groom.position[groom.first_section[w] + groom.sections(w) / 2]);
    std::iota(order.begin(), order.end(), 0u);
    order_by_sixteens(middle, order);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return groom.sections(a) > groom.sections(b);
    });
    return order;
}

} // namespace

Layout::Layout(const Groom& groom) {
    const std::size_t wisps = groom.wisp_count();
    const std::vector<std::uint32_t> order = in_packets(groom);

    slots_.resize(groom.section_count());
    wisp_of_.resize(groom.section_count());
    simulated_.resize(groom.section_count());
    for (std::size_t first = 0; first < wisps; first += kLanes) {
        Packet packet;
        packet.first_row = static_cast<std::uint32_t>(rows_);
        packet.rows = groom.sections(order[first]);
        packet.wisp.fill(kNoWisp);
        for (std::uint32_t lane = 0; lane < kLanes && first + lane < wisps; ++lane) {
            const std::uint32_t w = order[first + lane];
            packet.wisp[lane] = w;
            packet.sections[lane] = groom.sections(w);
            for (std::uint32_t i = 0; i < groom.sections(w); ++i) {
                const std::uint32_t section = groom.first_section[w] + i;
                slots_[section] = {packet.first_row + i, lane};
                wisp_of_[section] = w;
                simulated_[section] = i >= 2;
            }
        }
        rows_ += packet.rows;
        packets_.push_back(packet);
    }
}

} // namespace mane
