#include "interactions/contact_points.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "interactions/contact_points.cpp"
#include <hwy/foreach_target.h>

#include "base/blocks-inl.h"

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
    /// Writes a part of a section's shape.
    HWY_INLINE void put(Pack3 v, Vec3 SectionShape::*part) const {
        alignas(64) Four lanes[kPackLanes];
        interleave(v, lanes);
        for (std::size_t lane = 0; lane < kPackLanes; ++lane)
            if (rank_[lane] != ContactOrder::kNone)
                points_.shape[rank_[lane]].*part = first_three(lanes[lane]);
    }
    HWY_INLINE void put(Pack x, float SectionShape::*part) const {
        put(x, [&](std::uint32_t rank) -> float& { return points_.shape[rank].*part; });
    }
    HWY_INLINE void put_radius(std::size_t k, Pack r) const {
        put(r, [&](std::uint32_t rank) -> float& { return points_.shape[rank].radius[k]; });
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
    static HWY_INLINE void interleave(Pack3 v, Four* lanes) {
        hn::StoreInterleaved4(v.x.v, v.y.v, v.z.v, Pack(0.f).v, Tag(),
                              reinterpret_cast<float*>(lanes));
    }
    template <typename Where> HWY_INLINE void put(Pack3 v, Where&& where) const {
        alignas(64) Four lanes[kPackLanes];
        interleave(v, lanes);
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
    lanes.put(x, &SectionShape::x);
    lanes.put(n, &SectionShape::normal);
    lanes.put(u, &SectionShape::u);
    lanes.put(v, &SectionShape::v);
    lanes.put(n, points.normal);
    if (!in_head)
        lanes.put_place(0, x);
    Pack largest(0.f), area(0.f);
    for (std::uint32_t k = 0; k < hair.half_lines.size(); ++k) {
        const Pack r = radius(k), next = radius(k + 1 < hair.half_lines.size() ? k + 1 : 0);
        const Pack3 d = half_line(hair.half_lines[k], u, v);
        lanes.put_point(k + 1, d, points.half_line);
        lanes.put_radius(k, r);
        if (!in_head)
            lanes.put_place(k + 1, x + d * r);
        largest = larger(largest, r);
        area = area + r * next;
    }
    const Pack3 extent = disc_extent(n, largest);
    lanes.put(x - extent, points.low);
    lanes.put(x + extent, points.high);
    lanes.put(area, &SectionShape::area);
    lanes.put(largest, &SectionShape::largest);
}

void find_directions(ContactPoints& points, std::size_t first, std::size_t last) {
    for (std::size_t r = first; r < last; ++r) {
        const auto rank = static_cast<std::uint32_t>(r);
        const std::uint32_t next = points.order.next(rank);
        if (next == ContactOrder::kNone)
            continue;
        const SectionShape &from = points.shape[rank], &to = points.shape[next];
        const Vec3 axis = to.x - from.x;
        points.direction[rank] = four(normalized(axis));
        float radii = 0;
        for (std::uint32_t k = 0; k + 1 < points.per_section; ++k)
            radii += from.radius[k] + to.radius[k];
        points.slenderness[rank] =
            length(axis) * static_cast<float>(points.per_section - 1) / std::max(radii, 1e-6f);
    }
}

/// Four numbers per lane, from rows to ranks and back.
HWY_INLINE void to_ranks(const Pack* row, const std::uint32_t* rank, std::size_t stride,
                         Four* target) {
    alignas(64) Four lanes[kPackLanes];
    hn::StoreInterleaved4(row[0].v, row[1].v, row[2].v, row[3].v, Tag(),
                          reinterpret_cast<float*>(lanes));
    for (std::size_t lane = 0; lane < kPackLanes; ++lane)
        if (rank[lane] != ContactOrder::kNone)
            target[rank[lane] * stride] = lanes[lane];
}
HWY_INLINE void from_ranks(const Four* source, std::size_t stride, const std::uint32_t* rank,
                           Pack* row) {
    alignas(64) Four lanes[kPackLanes];
    for (std::size_t lane = 0; lane < kPackLanes; ++lane)
        lanes[lane] = rank[lane] != ContactOrder::kNone ? source[rank[lane] * stride] : Four{};
    hn::LoadInterleaved4(Tag(), reinterpret_cast<const float*>(lanes), row[0].v, row[1].v, row[2].v,
                         row[3].v);
}

/// Calls `work` with the row and first lane of all vectors of packets [first, last).
template <typename Work>
HWY_INLINE void for_rows(const Layout& layout, std::size_t first, std::size_t last, Work&& work) {
    for (std::size_t p = first; p < last; ++p) {
        const Packet& packet = layout.packets()[p];
        for (std::size_t row = packet.first_row; row < packet.first_row + packet.rows; ++row)
            for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
                work(row, lane);
    }
}

void take_motion(const HairView& hair, ContactPoints& points, std::size_t first, std::size_t last) {
    SectionMotion& motion = points.motion;
    const std::size_t k_count = points.per_section - 1;
    for_rows(hair.layout, first, last, [&](std::size_t row, std::size_t lane) {
        const std::uint32_t* rank = points.order.row(row) + lane;
        const Pack3 v = Pack3::load(hair.state.velocity.row(row) + lane);
        const Pack none(0.f), skeleton[4] = {v.x, v.y, v.z, none};
        to_ranks(skeleton, rank, 1, motion.skeleton.data());
        for (std::size_t f = 0; f < motion.fours; ++f) {
            Pack rates[4];
            for (std::size_t i = 0; i < 4; ++i)
                rates[i] =
                    4 * f + i < k_count
                        ? Pack::load(hair.state.radius_rate.row(row) + (4 * f + i) * kLanes + lane)
                        : none;
            to_ranks(rates, rank, motion.fours, motion.rate.data() + f);
        }
    });
}

void take_places(const HairView& hair, ContactPoints& points, std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
        const std::size_t in_head = hair.layout.packets()[p].first_row;
        for_rows(hair.layout, p, p + 1, [&](std::size_t row, std::size_t lane) {
            take_row(hair, points, row, lane, row == in_head);
        });
    }
}

/// An envelope point moves with its skeleton point, and along its half line.
template <int kPlace> HWY_INLINE void
find_envelope_velocities(ContactPoints& points, std::size_t bunch, std::uint32_t code) {
    const SectionMotion& motion = points.motion;
    const std::size_t rank = bunch * kLanes, fours = motion.fours, f = (code - 1) / 4;
    const std::size_t place = points.place(static_cast<std::uint32_t>(rank), code);
    for (std::size_t i = 0; i < kLanes; i += Blocks::kCount) {
        const Blocks rates = Blocks::every(motion.rate.data() + (rank + i) * fours + f, fours);
        const Blocks v = Blocks::load(motion.skeleton.data() + rank + i) +
                         Blocks::load(points.half_line.data() + place + i) * rates.all<kPlace>();
        v.store(points.velocity.data() + place + i);
    }
}

void find_velocities(ContactPoints& points, std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
        std::copy_n(points.motion.skeleton.data() + b * kLanes, std::size_t{kLanes},
                    points.velocity.data() + points.place(static_cast<std::uint32_t>(b * kLanes)));
        for (std::uint32_t code = 1; code < points.per_section; ++code) {
            switch ((code - 1) % 4) {
            case 0:
                find_envelope_velocities<0>(points, b, code);
                break;
            case 1:
                find_envelope_velocities<1>(points, b, code);
                break;
            case 2:
                find_envelope_velocities<2>(points, b, code);
                break;
            default:
                find_envelope_velocities<3>(points, b, code);
            }
        }
    }
}

void add_motion(const ContactPoints& points, const Layout& layout, const SectionMotion& change,
                State& state, std::size_t first, std::size_t last) {
    const std::size_t k_count = points.per_section - 1;
    for_rows(layout, first, last, [&](std::size_t row, std::size_t lane) {
        const std::uint32_t* rank = points.order.row(row) + lane;
        Pack by[4];
        from_ranks(change.skeleton.data(), 1, rank, by);
        float* velocity = state.velocity.row(row) + lane;
        (Pack3::load(velocity) + Pack3{by[0], by[1], by[2]}).store(velocity);
        for (std::size_t f = 0; f < change.fours; ++f) {
            from_ranks(change.rate.data() + f, change.fours, rank, by);
            for (std::size_t i = 0; i < 4 && 4 * f + i < k_count; ++i) {
                float* rate = state.radius_rate.row(row) + (4 * f + i) * kLanes + lane;
                (Pack::load(rate) + by[i]).store(rate);
            }
        }
    });
}

ContactPointKernels point_kernels() {
    return {take_places, find_directions, take_motion, find_velocities, add_motion};
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

float designed_area(const Groom& groom, std::uint32_t section) {
    const std::uint32_t k_count = groom.envelope_points;
    const float* radius = groom.radius.data() + std::size_t{section} * k_count;
    float area = 0;
    for (std::uint32_t k = 0; k < k_count; ++k)
        area += radius[k] * radius[k + 1 < k_count ? k + 1 : 0];
    return area;
}

ContactPoints contact_points(const HairView& hair) {
    constexpr float kFarAway = 1e30f; // [m] where nothing is
    const Groom& groom = hair.groom;
    ContactPoints p;
    p.order = ContactOrder(groom, hair.layout);
    p.per_section = groom.envelope_points + 1;
    p.half_lines.assign(hair.half_lines.begin(), hair.half_lines.end());
    // Of three half lines, an ellipse through a long and a short one bulges over the long one.
    if (p.half_lines[1].cosine < 0)
        p.bulge = 1 / p.half_lines[1].sine;
    const std::size_t ranks = p.order.size();
    p.shape.assign(p.padded_ranks(), {});
    for (std::uint32_t r = 0; r < ranks; ++r) {
        const std::uint32_t section = p.order.section(r);
        p.shape[r].rest_area = designed_area(groom, section);
        p.wisp.push_back(hair.layout.wisp_of(section));
        p.held.push_back(hair.layout.simulated(section) ? 0 : 1);
    }
    p.motion.resize(p.padded_ranks(), groom.envelope_points);
    for (AlignedVector<Four>* per_rank : {&p.normal, &p.low, &p.high, &p.direction})
        per_rank->assign(p.padded_ranks(), Four{});
    p.slenderness.assign(p.padded_ranks(), 0.f);
    for (AlignedVector<float>* per_place : {&p.x, &p.y, &p.z})
        per_place->assign(p.places(), kFarAway);
    p.half_line.assign(p.places(), Four{});
    p.velocity.assign(p.places(), Four{});
    return p;
}

} // namespace mane
#endif
