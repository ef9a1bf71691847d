// Stage 4 of §5.1 and the kinematic roots, sixteen wisps at a time.
#if defined(MANE_STEP_POSITIONS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_POSITIONS_INL_H
#undef MANE_STEP_POSITIONS_INL_H
#else
#define MANE_STEP_POSITIONS_INL_H
#endif

#include "base/pack-inl.h"
#include "step/hermite.h"
#include "step/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// A cubic Hermite curve's weights, for roots.
struct Hermite {
    Pack value[2], slope[2];

    HWY_INLINE explicit Hermite(const HermiteWeights& w)
        : value{w.value[0], w.value[1]}, slope{w.slope[0], w.slope[1]} {}
    HWY_INLINE Pack3 blend(const RootMotion& roots, RootMotion::Column column, std::size_t packet,
                           std::size_t lane) const {
        const std::size_t offset = column * 3 * kLanes + lane;
        Pack3 sum = Pack3::load(roots.value[0].row(packet) + offset) * value[0];
        sum = sum + Pack3::load(roots.value[1].row(packet) + offset) * value[1];
        sum = sum + Pack3::load(roots.slope[0].row(packet) + offset) * slope[0];
        return sum + Pack3::load(roots.slope[1].row(packet) + offset) * slope[1];
    }
};

void move_root_velocities(const KernelData& data, float s, std::size_t first, std::size_t last) {
    const Hermite rate(HermiteWeights::rate_at(s));
    const Pack per_second(1.f / data.roots.seconds);
    for (std::size_t p = first; p < last; ++p) {
        const std::size_t row = data.layout.packets()[p].first_row;
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes) {
            (rate.blend(data.roots, RootMotion::inside, p, lane) * per_second)
                .store(data.state.velocity.row(row) + lane);
            (rate.blend(data.roots, RootMotion::outside, p, lane) * per_second)
                .store(data.state.velocity.row(row + 1) + lane);
        }
    }
}

HWY_INLINE void advance_section(const KernelData& data, std::size_t row, std::size_t lane, Pack h) {
    float* x = data.state.position.row(row) + lane;
    (Pack3::load(x) + Pack3::load(data.state.velocity.row(row) + lane) * h).store(x);
    for (std::size_t k = 0; k < data.half_lines.size(); ++k) {
        float* radius = data.state.radius.row(row) + k * kLanes + lane;
        float* rate = data.state.radius_rate.row(row) + k * kLanes + lane;
        const Pack speed = Pack::load(rate), r = Pack::load(radius) + speed * h;
        const Mask flat = r < Pack(0.f); // M9: on its half line only
        select(flat, Pack(0.f), r).store(radius);
        if (!none(flat)) [[unlikely]]
            select(flat, Pack(0.f), speed).store(rate);
    }
}

void place_roots(const KernelData& data, float s, std::size_t first, std::size_t last) {
    const Hermite place(HermiteWeights::at(s));
    for (std::size_t p = first; p < last; ++p) {
        const std::size_t row = data.layout.packets()[p].first_row;
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes) {
            place.blend(data.roots, RootMotion::inside, p, lane)
                .store(data.state.position.row(row) + lane);
            place.blend(data.roots, RootMotion::outside, p, lane)
                .store(data.state.position.row(row + 1) + lane);
            place.blend(data.roots, RootMotion::axis, p, lane).store(data.root_axis.row(p) + lane);
        }
    }
}

void process_positions(const KernelData& data, float s, std::size_t first, std::size_t last) {
    const Pack h(data.step);
    place_roots(data, s, first, last);
    for (std::size_t p = first; p < last; ++p) {
        const Packet& packet = data.layout.packets()[p];
        for (std::size_t row = packet.first_row + 2; row < packet.first_row + packet.rows; ++row)
            for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
                advance_section(data, row, lane, h);
    }
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
