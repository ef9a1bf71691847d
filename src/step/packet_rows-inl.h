// Where the forces on one packet find and leave their numbers.
#if defined(MANE_STEP_PACKET_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_STEP_PACKET_ROWS_INL_H
#undef MANE_STEP_PACKET_ROWS_INL_H
#else
#define MANE_STEP_PACKET_ROWS_INL_H
#endif

#include "model/frames-inl.h"
#include "step/kernels.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

HWY_INLINE Pack rest_value(const float* row, Rest column) {
    return Pack::load(row + static_cast<std::uint32_t>(column) * kLanes);
}

/// Rows one after the other, as the lanes of a Pack see them. A copy of what says where they are:
/// it stays in registers, while for all that a compiler knows whatever is stored may change the
/// original.
template <typename Number> class LaneRows {
  public:
    LaneRows() = default;
    template <typename AllRows>
    HWY_INLINE LaneRows(AllRows& rows, std::size_t first, std::size_t lane)
        : first_(rows.row(first) + lane), width_(rows.components() * kLanes) {}
    HWY_INLINE Number* operator[](std::size_t i) const { return first_ + i * width_; }

  private:
    Number* first_ = nullptr;
    std::size_t width_ = 0;
};

/// The sections of one packet's wisps, from the root on.
struct PacketRows {
    std::size_t tip; ///< of the longest wisp
    LaneRows<const float> rest, position, radius, wind;
    LaneRows<float> velocity, radius_rate, normal, u, v, all_scratch;

    HWY_INLINE PacketRows(const KernelData& data, std::size_t packet, std::size_t lane) {
        const std::size_t root = data.layout.packets()[packet].first_row;
        tip = data.layout.packets()[packet].rows - 1;
        rest = {data.rest, root, lane};
        position = {data.state.position, root, lane};
        velocity = {data.state.velocity, root, lane};
        radius = {data.state.radius, root, lane};
        radius_rate = {data.state.radius_rate, root, lane};
        normal = {data.frames.normal, root, lane};
        u = {data.frames.u, root, lane};
        v = {data.frames.v, root, lane};
        all_scratch = {data.scratch, packet / kPacketsPerChunk * data.layout.most_rows(), lane};
        if (data.wind)
            wind = {*data.wind, root, lane};
    }
    HWY_INLINE float* scratch(std::size_t i, std::uint32_t column) const {
        return all_scratch[i] + column * kLanes;
    }
    HWY_INLINE SectionAxes axes(std::size_t i) const {
        return {Pack3::load(normal[i]), Pack3::load(u[i]), Pack3::load(v[i])};
    }
};

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
