#include "interactions/contact_points.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "interactions/contact_points.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

// [m] rounding must not leave a section's own envelope point outside its segment's box
constexpr float kBoxMargin = 1e-5f;

/// Some lanes of a packet's row, and where their sections are in the order of contacts.
class RowLanes {
  public:
    HWY_INLINE RowLanes(ContactPoints& points, std::size_t row, std::size_t lane)
        : points_(points), rank_(points.order.row(row) + lane) {}

    /// Writes a vector per section.
    HWY_INLINE void put(Pack3 v, AlignedVector<Four>& target) const {
        put(v, [&](std::uint32_t rank) -> Four& { return target[rank]; });
    }
    HWY_INLINE void put(Pack x, AlignedVector<float>& target) const {
        put(x, [&](std::uint32_t rank) -> float& { return target[rank]; });
    }
    /// Writes one of a section's points.
    HWY_INLINE void put_point(std::uint32_t code, Pack3 v, AlignedVector<Four>& target) const {
        put(v, [&](std::uint32_t rank) -> Four& { return target[points_.place(rank, code)]; });
    }
    HWY_INLINE void put_point(std::uint32_t code, Pack x, AlignedVector<float>& target) const {
        put(x, [&](std::uint32_t rank) -> float& { return target[points_.place(rank, code)]; });
    }
    HWY_INLINE void put_place(std::uint32_t code, Pack3 v) const {
        put_point(code, v.x, points_.x);
        put_point(code, v.y, points_.y);
        put_point(code, v.z, points_.z);
    }

  private:
    template <typename Where> HWY_INLINE void put(Pack3 v, Where&& where) const {
        alignas(64) Four lanes[kPackLanes];
        hn::StoreInterleaved4(v.x.v, v.y.v, v.z.v, Pack(0.f).v, Tag(),
                              reinterpret_cast<float*>(lanes));
        for (std::size_t lane = 0; lane < kPackLanes; ++lane)
            if (rank_[lane] != ContactOrder::kNone)
                where(rank_[lane]) = lanes[lane];
    }
    template <typename Where> HWY_INLINE void put(Pack x, Where&& where) const {
        alignas(64) float lanes[kPackLanes];
        x.store(lanes);
        for (std::size_t lane = 0; lane < kPackLanes; ++lane)
            if (rank_[lane] != ContactOrder::kNone)
                where(rank_[lane]) = lanes[lane];
    }

    ContactPoints& points_;
    const std::uint32_t* rank_;
};

HWY_INLINE Pack3 half_line(const HalfLine& d, Pack3 u, Pack3 v) {
    return u * Pack(d.cosine) + v * Pack(d.sine);
}

/// Half the size, per world axis, of a disc of radius r.
HWY_INLINE Pack3 disc_extent(Pack3 n, Pack r) {
    const auto side = [r](Pack c) {
        return r * square_root(larger(Pack(1.f) - c * c, Pack(0.f))) + Pack(kBoxMargin);
    };
    return {side(n.x), side(n.y), side(n.z)};
}

/// Points inside the head, of x₀, touch nothing: they stay far away.
HWY_INLINE void take_row(const HairView& hair, ContactPoints& points, std::size_t row,
                         std::size_t lane, bool in_head) {
    const RowLanes lanes(points, row, lane);
    const Pack3 x = Pack3::load(hair.state.position.row(row) + lane),
                u = Pack3::load(hair.frames.u.row(row) + lane),
                v = Pack3::load(hair.frames.v.row(row) + lane),
                n = Pack3::load(hair.frames.normal.row(row) + lane);
    const auto radius = [&](std::size_t k) {
        return Pack::load(hair.state.radius.row(row) + k * kLanes + lane);
    };
    lanes.put(x, points.position);
    lanes.put(n, points.normal);
    lanes.put(v, points.second_axis);
    if (!in_head)
        lanes.put_place(0, x);
    Pack largest(0.f), area(0.f);
    for (std::uint32_t k = 0; k < hair.half_lines.size(); ++k) {
        const Pack r = radius(k), next = radius(k + 1 < hair.half_lines.size() ? k + 1 : 0);
        const Pack3 d = half_line(hair.half_lines[k], u, v);
        lanes.put_point(k + 1, d, points.half_line);
        lanes.put_point(k + 1, r, points.radius);
        if (!in_head)
            lanes.put_place(k + 1, x + d * r);
        largest = larger(largest, r);
        area = area + r * next;
    }
    const Pack3 extent = disc_extent(n, largest);
    lanes.put(x - extent, points.low);
    lanes.put(x + extent, points.high);
    lanes.put(area, points.area);
}

void take_places(const HairView& hair, ContactPoints& points, std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
        const Packet& packet = hair.layout.packets()[p];
        for (std::size_t row = packet.first_row; row < packet.first_row + packet.rows; ++row)
            for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
                take_row(hair, points, row, lane, row == packet.first_row);
    }
}

void find_directions(ContactPoints& points, std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
        const auto rank = static_cast<std::uint32_t>(r);
        const std::uint32_t next = points.order.next(rank);
        if (next == ContactOrder::kNone)
            continue;
        const Vec3 axis = first_three(points.position[next]) - first_three(points.position[rank]);
        points.direction[rank] = four(normalized(axis));
        float radii = 0;
        for (std::uint32_t code = 1; code < points.per_section; ++code)
            radii +=
                points.radius[points.place(rank, code)] + points.radius[points.place(next, code)];
        points.slenderness[rank] =
            length(axis) * static_cast<float>(points.per_section - 1) / std::max(radii, 1e-6f);
    }
}

void take_velocities(const HairView& hair, ContactPoints& points, std::size_t first,
                     std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
        const Packet& packet = hair.layout.packets()[p];
        for (std::size_t row = packet.first_row; row < packet.first_row + packet.rows; ++row) {
            for (std::size_t lane = 0; lane < kLanes; ++lane) {
                const std::uint32_t rank = points.order.row(row)[lane];
                if (rank == ContactOrder::kNone)
                    continue;
                const float *v = hair.state.velocity.row(row) + lane,
                            *rate = hair.state.radius_rate.row(row) + lane;
                const Four skeleton{v[0], v[kLanes], v[2 * kLanes], 0};
                std::size_t at = points.place(rank);
                points.velocity[at] = skeleton;
                for (std::size_t k = 0; k + 1 < points.per_section; ++k) {
                    at += kLanes;
                    points.velocity[at] = skeleton + points.half_line[at] * four(rate[k * kLanes]);
                }
            }
        }
    }
}

ContactPointKernels point_kernels() {
    return {take_places, find_directions, take_velocities};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(point_kernels);

ContactPointKernels contact_point_kernels(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(point_kernels)();
}

ContactPoints contact_points(const HairView& hair) {
    constexpr float kFarAway = 1e30f; // [m] where nothing is
    const Groom& groom = hair.groom;
    ContactPoints p;
    p.order = ContactOrder(groom, hair.layout);
    p.per_section = groom.envelope_points + 1;
    p.half_lines.assign(hair.half_lines.begin(), hair.half_lines.end());
    const std::size_t ranks = p.order.size();
    for (std::uint32_t r = 0; r < ranks; ++r) {
        const std::uint32_t section = p.order.section(r), k_count = groom.envelope_points;
        const float* radius = groom.radius.data() + std::size_t{section} * k_count;
        float area = 0;
        for (std::uint32_t k = 0; k < k_count; ++k)
            area += radius[k] * radius[k + 1 < k_count ? k + 1 : 0];
        p.rest_area.push_back(area);
        p.wisp.push_back(hair.layout.wisp_of(section));
        p.held.push_back(hair.layout.simulated(section) ? 0 : 1);
    }
    for (AlignedVector<Four>* per_rank :
         {&p.position, &p.normal, &p.second_axis, &p.low, &p.high, &p.direction})
        per_rank->assign(ranks, Four{});
    for (AlignedVector<float>* per_rank : {&p.area, &p.slenderness})
        per_rank->assign(ranks, 0.f);
    for (AlignedVector<float>* per_place : {&p.x, &p.y, &p.z})
        per_place->assign(p.places(), kFarAway);
    p.radius.assign(p.places(), 0.f);
    p.half_line.assign(p.places(), Four{});
    p.velocity.assign(p.places(), Four{});
    return p;
}

} // namespace mane
#endif
