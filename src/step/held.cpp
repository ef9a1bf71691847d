#include "step/held.h"

#include "character/ease.h"
#include "step/hermite.h"

namespace mane {
namespace {

template <typename T> T hermite(const T (&value)[2], const T (&slope)[2], float s) {
    const HermiteWeights w = HermiteWeights::at(s);
    return value[0] * w.value[0] + value[1] * w.value[1] + slope[0] * w.slope[0] +
           slope[1] * w.slope[1];
}
template <typename T> T hermite_rate(const T (&value)[2], const T (&slope)[2], float s) {
    const HermiteWeights w = HermiteWeights::rate_at(s);
    // by the difference: what stays where it is has no rate, not even by rounding
    return (value[1] - value[0]) * w.value[1] + slope[0] * w.slope[0] + slope[1] * w.slope[1];
}

Vec3 velocity_at(const Held::Point& point, float s, float block_seconds) {
    return hermite_rate(point.value, point.slope, s) / block_seconds;
}

} // namespace

void Held::lead_radii(double begin, double end) {
    for (Radius& r : radii)
        for (const int e : {0, 1}) {
            const Slope share = ease(e == 0 ? begin : end);
            const float way = r.to - r.from;
            r.value[e] = share.value < 1 ? r.from + way * static_cast<float>(share.value) : r.to;
            r.slope[e] = way * static_cast<float>(share.rate * (end - begin));
        }
}

void Held::note_velocities(const State& state) {
    for (Point& point : points)
        point.before = state.velocity.vec(point.slot);
}

void Held::accelerate_envelopes(const KernelData& data, float s) const {
    for (const Point& point : points) {
        const Slot slot = point.slot;
        const Vec3 air = data.wind ? data.wind->vec(slot) : data.uniform_wind;
        const Vec3 free = data.gravity + (air - point.before) * data.drag;
        const Vec3 asked =
            (velocity_at(point, s, data.roots.seconds) - point.before) / data.step - free;
        const float u = dot(asked, data.frames.u.vec(slot)),
                    v = dot(asked, data.frames.v.vec(slot));
        for (std::uint32_t k = 0; k < data.half_lines.size(); ++k) {
            const HalfLine& line = data.half_lines[k];
            data.state.radius_rate.at(slot, k) -= (u * line.cosine + v * line.sine) * data.step;
        }
    }
}

void Held::move(State& state, float s, float block_seconds) const {
    for (const Point& point : points)
        state.velocity.set(point.slot, velocity_at(point, s, block_seconds));
    for (const Radius& r : radii)
        state.radius_rate.at(r.slot, r.k) = hermite_rate(r.value, r.slope, s) / block_seconds;
}

void Held::place(State& state, float s) const {
    for (const Point& point : points)
        state.position.set(point.slot, hermite(point.value, point.slope, s));
    for (const Radius& r : radii)
        state.radius.at(r.slot, r.k) = hermite(r.value, r.slope, s);
}

} // namespace mane
