#include "interactions/contact_geometry.h"

namespace mane {
namespace {

constexpr std::size_t kPacketsPerChunk = 32;
constexpr std::size_t kBunchesPerChunk = 128;
constexpr std::size_t kRanksPerChunk = 2048;

} // namespace

ContactGeometry::ContactGeometry(const std::string& instruction_set)
    : kernels_(contact_point_kernels(instruction_set)) {}

void ContactGeometry::take(const HairView& hair, Threads& threads) {
    if (points_.order.size() == 0)
        points_ = contact_points(hair);
    threads.run_ranges(hair.layout.packets().size(), kPacketsPerChunk,
                       [&](std::size_t first, std::size_t last) {
                           kernels_.take_places(hair, points_, first, last);
                       });
    take_velocities(hair, threads);
    threads.run_ranges(points_.order.size(), kRanksPerChunk,
                       [&](std::size_t first, std::size_t last) {
                           kernels_.find_directions(points_, first, last);
                       });
}

void ContactGeometry::take_velocities(const HairView& hair, Threads& threads) {
    threads.run_ranges(hair.layout.packets().size(), kPacketsPerChunk,
                       [&](std::size_t first, std::size_t last) {
                           kernels_.take_motion(hair, points_, first, last);
                       });
    threads.run_ranges(points_.bunches(), kBunchesPerChunk,
                       [&](std::size_t first, std::size_t last) {
                           kernels_.find_velocities(points_, first, last);
                       });
}

void ContactGeometry::change_design(const Groom& groom) {
    for (std::uint32_t r = 0; r < points_.order.size(); ++r)
        points_.shape[r].rest_area = designed_area(groom, points_.order.section(r));
}

void ContactGeometry::add_to(State& state, const Layout& layout, const SectionMotion& change,
                             Threads& threads) const {
    threads.run_ranges(layout.packets().size(), kPacketsPerChunk,
                       [&](std::size_t first, std::size_t last) {
                           kernels_.add_motion(points_, layout, change, state, first, last);
                       });
}

} // namespace mane
