#include "interactions/axis_search.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "interactions/axis_search.cpp"
#include <hwy/foreach_target.h>

#include "interactions/box_search-inl.h"
#include "interactions/point_test.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// [m] over all rounding in single precision, within metres of the origin
constexpr float kOverRounding = 4e-6f;

/// The axis of one segment, as others are held against it.
struct Axis {
    std::uint32_t rank = 0;
    Vec3 x, way, direction;
    float widest = 0;
    Box box;

    Axis() = default;
    Axis(const ContactPoints& points, const AxisBunch* axes, std::uint32_t begin)
        : rank(begin), direction(first_three(points.direction[rank])),
          box(segment_box(points, rank)) {
        const AxisBunch& own = axes[rank / kLanes];
        const std::size_t lane = rank % kLanes;
        x = {own.x[0][lane], own.x[1][lane], own.x[2][lane]};
        way = {own.way[0][lane], own.way[1][lane], own.way[2][lane]};
        widest = own.widest[lane];
    }
};

HWY_INLINE Pack3 load(const float (&rows)[3][kLanes], std::size_t lane) {
    return {Pack::load(rows[0] + lane), Pack::load(rows[1] + lane), Pack::load(rows[2] + lane)};
}

HWY_INLINE Mask aslant(const ContactPoints& points, const Axis& axis, std::size_t first,
                       float least_sine) {
    Pack3 other;
    Pack spare;
    hn::LoadInterleaved4(Tag(), reinterpret_cast<const float*>(points.direction.data() + first),
                         other.x.v, other.y.v, other.z.v, spare.v);
    const Pack3 n = cross(broadcast(axis.direction), other);
    return {hn::Not((dot(n, n) < Pack(least_sine * least_sine)).m)};
}

/// Where two lines are nearest to each other, as axis_contact() has it: between both axes' ends,
/// and no farther apart than two surfaces reach. Sums of products as there, to the bit, whichever
/// of the two comes first there (that turns signs alone); places that its division rounds to an end
/// are let through.
HWY_INLINE Mask nearest_between_ends(const AxisBunch& others, const Axis& axis, std::size_t lane) {
    const Pack zero(0.f);
    const Pack3 d = broadcast(axis.way), e = load(others.way, lane), b = load(others.x, lane),
                r = broadcast(axis.x) - b;
    const Pack dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
    const Pack det = dd * ee - de * de, s = de * er - ee * dr, t = dd * er - de * dr;
    const Mask between = both(both(s > zero, s <= det), both(both(t > zero, t <= det), det > zero));
    if (none(between))
        return between;
    const Pack by = Pack(1.f) / det;
    const Pack3 gap = (b + e * (t * by)) - (broadcast(axis.x) + d * (s * by));
    const Pack reach = Pack(axis.widest + kOverRounding) + Pack::load(others.widest + lane);
    return both(between, dot(gap, gap) <= reach * reach);
}

/// One bit per lane of a bunch: those that do not find the axis that begins at `rank` themselves.
HWY_INLINE std::uint32_t left_to(std::uint32_t rank, std::uint32_t bunch, std::uint32_t slender) {
    const std::uint32_t own = rank / kLanes, lane = rank % kLanes;
    constexpr std::uint32_t kAll = (1u << kLanes) - 1;
    const std::uint32_t lower = bunch < own ? kAll : bunch == own ? (1u << lane) - 1 : 0;
    const std::uint32_t itself = bunch == own ? 1u << lane : 0;
    return kAll & ~(lower & slender) & ~itself;
}

/// Appends the segments of a bunch that an axis may meet.
HWY_INLINE void find_in_bunch(const ContactPoints& points, const AxisBunch* axes,
                              std::uint32_t bunch, const Axis& axis, float least_sine,
                              std::vector<std::uint32_t>& found) {
    const AxisBunch& there = axes[bunch];
    const std::uint32_t candidates = left_to(axis.rank, bunch, there.slender);
    if (candidates == 0)
        return;
    for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes) {
        const Mask overlaps = overlap(there.boxes, lane, axis.box);
        if (none(overlaps))
            continue;
        const Mask meets = both(overlaps, nearest_between_ends(there, axis, lane));
        if (none(meets))
            continue;
        const std::size_t first = bunch * kLanes + lane;
        for (std::uint32_t bits =
                 bits_of(both(meets, aslant(points, axis, first, least_sine))) & candidates >> lane;
             bits != 0; bits &= bits - 1)
            found.push_back(
                static_cast<std::uint32_t>(first + hwy::Num0BitsBelowLS1Bit_Nonzero32(bits)));
    }
}

void find(const ContactPoints& points, const AxisBunch* axes, std::span<const std::uint32_t> ranks,
          float least_sine, const NearBoxes& near, std::vector<std::uint32_t>* found) {
    Axis group[kLanes];
    BoxTree::Node boxes;
    boxes.clear();
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        group[i] = Axis(points, axes, ranks[i]);
        boxes.set(i, group[i].box);
        found[i].clear();
    }
    // Each bunch is fetched once for all segments that it is near.
    for (std::size_t n = 0; n < near.items.size(); ++n)
        for (std::uint32_t left = children_in(boxes, near.nodes[n / kLanes].box(n % kLanes));
             left != 0; left &= left - 1) {
            const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
            find_in_bunch(points, axes, near.items[n], group[i], least_sine, found[i]);
        }
}

AxisSearch axis_search() {
    return {find};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(axis_search);

AxisSearch axis_search_for(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(axis_search)();
}

void AxisBunch::clear() {
    *this = {};
    boxes.clear();
}

void AxisBunch::set(const ContactPoints& points, std::uint32_t rank, bool is_slender) {
    const std::size_t lane = rank % kLanes;
    slender |= std::uint32_t{is_slender} << lane;
    const Vec3 from = points.shape[rank].x, to = points.shape[points.order.next(rank)].x - from;
    boxes.set(lane, segment_box(points, rank));
    x[0][lane] = from.x, x[1][lane] = from.y, x[2][lane] = from.z;
    way[0][lane] = to.x, way[1][lane] = to.y, way[2][lane] = to.z;
    widest[lane] = points.bulge * std::max(points.shape[rank].largest,
                                           points.shape[points.order.next(rank)].largest);
}

} // namespace mane
#endif
