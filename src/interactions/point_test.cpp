#include "interactions/point_test.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "interactions/point_test.cpp"
#include <hwy/foreach_target.h>

#include "interactions/box_search-inl.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// What is not a number is in no box: a state that went wrong is told at the frame's end.
HWY_INLINE Mask in_box(const Box& box, const Pack3& p) {
    const auto within = [](float low, Pack x, float high) {
        return both(Pack(low) <= x, x <= Pack(high));
    };
    return both(both(within(box.low.x, p.x, box.high.x), within(box.low.y, p.y, box.high.y)),
                within(box.low.z, p.z, box.high.z));
}

/// The volume between two cross-sections, inside its box (M21).
struct SegmentVolume {
    const SectionShape *near, *far;
    std::uint32_t ranks[2]; // of its sections
    Box box;

    SegmentVolume(const ContactPoints& points, std::uint32_t rank)
        : near(&points.shape[rank]),
          far(&points.shape[points.order.next(rank)]), ranks{rank, points.order.next(rank)},
          box(segment_box(points, rank)) {}
    SegmentVolume() = default;
};

HWY_INLINE Pack mixed(float a, float b, Pack s) {
    return Pack(a) + Pack(b - a) * s;
}
HWY_INLINE Pack3 mixed(const Vec3& a, const Vec3& b, Pack s) {
    return {mixed(a.x, b.x, s), mixed(a.y, b.y, s), mixed(a.z, b.z, s)};
}
HWY_INLINE Pack radius_at(const SegmentVolume& v, std::size_t k, Pack s) {
    return larger(mixed(v.near->radius[k], v.far->radius[k], s), Pack(kSmallestRadius));
}

/// The square of the depth of section coordinates (a, b) at s (M14a).
HWY_INLINE Pack squared_depth_at(const SegmentVolume& volume,
                                 const std::vector<HalfLine>& half_lines, Pack a, Pack b, Pack s) {
    const Pack zero(0.f);
    if (half_lines.size() == 4) { // the paper's four: the signs tell the quadrant
        const Pack p = a / select(a < zero, radius_at(volume, 2, s), radius_at(volume, 0, s)),
                   q = b / select(b < zero, radius_at(volume, 3, s), radius_at(volume, 1, s));
        return p * p + q * q;
    }
    // The sector of (a, b) is the one in which both coordinates along its two half lines are not
    // negative; the largest smaller coordinate finds it without branches on signs of zeros.
    const Pack inverse_sine(1 / half_lines[1].sine), cosine(half_lines[1].cosine);
    Pack best(-1e30f), result = zero;
    for (std::size_t k = 0; k < half_lines.size(); ++k) {
        const std::size_t next = k + 1 < half_lines.size() ? k + 1 : 0;
        const HalfLine &d = half_lines[k], &e = half_lines[next];
        // (a, b) = α d + β e, solved by cross products
        const Pack alpha = (a * Pack(e.sine) - b * Pack(e.cosine)) * inverse_sine,
                   beta = (b * Pack(d.cosine) - a * Pack(d.sine)) * inverse_sine;
        const Pack least = smaller(alpha, beta);
        const Pack p = alpha / radius_at(volume, k, s), q = beta / radius_at(volume, next, s);
        const Mask better = least > best;
        best = select(better, least, best);
        result = select(better, p * p + q * q + Pack(2.f) * p * q * cosine, result);
    }
    return result;
}

/// Where points lie in a volume: along it, how deep, and whether at all.
struct Inside {
    Pack s, depth;
    Mask holds;
};
HWY_INLINE Inside inside(const SegmentVolume& volume, const std::vector<HalfLine>& half_lines,
                         const Pack3& p, Mask boxed) {
    const SectionShape &a = *volume.near, &b = *volume.far;
    const Pack h0 = dot(p - broadcast(a.x), broadcast(a.normal)),
               h1 = dot(broadcast(b.x) - p, broadcast(b.normal));
    // Where the planes cross inside the wisp, both distances are negative between them.
    const Pack zero(0.f), sum = h0 + h1;
    const Mask beside = {hn::Or((h0 * h1 < zero).m, hn::Eq(sum.v, zero.v))};
    const Mask between = {hn::AndNot(beside.m, boxed.m)};
    if (none(between))
        return {zero, zero, between};
    const Pack s = h0 / select(between, sum, Pack(1.f));

    const Pack3 off = p - mixed(a.x, b.x, s), u = mixed(a.u, b.u, s), v = mixed(a.v, b.v, s);
    // The interpolated axes are not quite orthonormal: solve the 2×2 system. Where the section
    // turned over there is no inside.
    const Pack uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), pu = dot(off, u), pv = dot(off, v);
    const Pack determinant = uu * vv - uv * uv;
    const Mask upright = both(between, determinant > Pack(1e-6f));
    const Pack inverse = Pack(1.f) / select(upright, determinant, Pack(1.f));
    const Pack depth = square_root(squared_depth_at(
        volume, half_lines, (pu * vv - pv * uv) * inverse, (pv * uu - pu * uv) * inverse, s));
    return {s, depth, {hn::AndNot((depth > Pack(1.f)).m, upright.m)}};
}

/// A section squeezed flat is not infinitely dense: strands fill at most a few times their share of
/// space.
HWY_INLINE Pack density_at(const SegmentVolume& volume, Pack s) {
    const SectionShape &a = *volume.near, &b = *volume.far;
    return smaller(mixed(a.rest_area, b.rest_area, s) /
                       larger(mixed(a.area, b.area, s), Pack(1e-12f)),
                   Pack(10.f));
}

/// Calls `found(node, child)` for the boxes of the tree that overlap `box`, in rising order.
template <typename Found>
HWY_INLINE void for_overlapping(const BoxTree& tree, const Box& box, Found&& found) {
    struct Visit {
        std::uint32_t node, left; // of its children in the box, those not yet visited
    };
    constexpr std::size_t kMostLevels = 9; // of a tree of 2³² boxes, and one
    Visit stack[kMostLevels];
    if (tree.levels() == 0)
        return;
    const std::size_t top = tree.levels() - 1;
    std::size_t level = top;
    stack[top] = {0, children_in(tree.node(top, 0), box)};
    for (;;) {
        Visit& now = stack[level];
        if (now.left == 0) {
            if (level == top)
                return;
            ++level;
            continue;
        }
        const auto child = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(now.left));
        now.left &= now.left - 1;
        if (level == 0) {
            found(now.node, child);
        } else {
            const std::uint32_t node = now.node * kLanes + child;
            --level;
            stack[level] = {node, children_in(tree.node(level, node), box)};
        }
    }
}

void gather(const BoxTree& tree, const Box& box, NearBoxes& near) {
    near.items.clear();
    for_overlapping(tree, box, [&](std::uint32_t node, std::uint32_t child) {
        const std::size_t at = near.items.size(), n = at / kLanes, c = at % kLanes;
        if (c == 0) {
            if (near.nodes.size() == n)
                near.nodes.emplace_back();
            near.nodes[n].clear();
        }
        near.nodes[n].set(c, tree.node(0, node).box(child));
        near.items.push_back(node * kLanes + child);
    });
}

/// Points that wait for the test: those in the box, a few vectors of them.
struct Waiting {
    static constexpr std::size_t kMost = 128;
    alignas(64) float x[kMost + 2 * kLanes], y[kMost + 2 * kLanes], z[kMost + 2 * kLanes];
    std::uint32_t point[kMost + 2 * kLanes]; // rank · 16 + code
    std::size_t count = 0;
};

/// The lanes whose ranks are those of a segment's own sections.
HWY_INLINE Mask own(const SegmentVolume& volume, Numbers rank) {
    return either(rank == Numbers(volume.ranks[0]), rank == Numbers(volume.ranks[1]));
}

/// Points of one code from rank `first` on.
HWY_INLINE void wait_if_near(const SegmentVolume& volume, const Pack3& p, std::uint32_t first,
                             std::uint32_t code, Waiting& waiting) {
    const Mask boxed = in_box(volume.box, p);
    if (none(boxed))
        return;
    const Numbers rank = Numbers::counting(first);
    const Mask near = {hn::AndNot(own(volume, rank).m, boxed.m)};
    if (none(near))
        return;
    const Packing packing(near);
    packing.store(p.x, waiting.x + waiting.count);
    packing.store(p.y, waiting.y + waiting.count);
    packing.store(p.z, waiting.z + waiting.count);
    packing.store(hn::Add(hn::ShiftLeft<4>(rank.v), Numbers(code).v),
                  waiting.point + waiting.count);
    waiting.count += packing.count();
}

HWY_INLINE void test_waiting(const SegmentVolume& volume, const std::vector<HalfLine>& half_lines,
                             Waiting& waiting, PointsInside& found) {
    const Tag tag;
    found.reserve(waiting.count);
    for (std::size_t first = 0; first < waiting.count; first += kPackLanes) {
        const Pack3 p{Pack::load(waiting.x + first), Pack::load(waiting.y + first),
                      Pack::load(waiting.z + first)};
        const Mask real = {hn::FirstN(tag, waiting.count - first)};
        const Inside in = inside(volume, half_lines, p, real);
        if (none(in.holds))
            continue;
        const Packing packing(in.holds);
        packing.store(in.s, found.s.data() + found.count);
        packing.store(in.depth, found.depth.data() + found.count);
        packing.store(density_at(volume, in.s), found.density.data() + found.count);
        packing.store(Numbers::load_any(waiting.point + first), found.point.data() + found.count);
        found.count += packing.count();
    }
    waiting.count = 0;
}

/// The volumes of a group of segments, and what waits for each.
struct VolumeGroup {
    SegmentVolume volume[kLanes];
    Waiting waiting[kLanes];
    BoxTree::Node boxes; // of the volumes
};

void find(const ContactPoints& points, std::span<const std::uint32_t> ranks, const NearBoxes& near,
          PointsInside* found) {
    VolumeGroup group;
    group.boxes.clear();
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        group.volume[i] = SegmentVolume(points, ranks[i]);
        group.boxes.set(i, group.volume[i].box);
        found[i].count = 0;
    }
    const auto test = [&](std::size_t i) {
        test_waiting(group.volume[i], points.half_lines, group.waiting[i], found[i]);
    };
    // Each bunch is fetched once for all segments that it is near.
    for (std::size_t n = 0; n < near.items.size(); ++n) {
        const std::uint32_t segments =
            children_in(group.boxes, near.nodes[n / kLanes].box(n % kLanes));
        if (segments == 0)
            continue;
        for (std::uint32_t code = 0; code < points.per_section; ++code)
            for (std::uint32_t lane = 0; lane < kLanes; lane += kPackLanes) {
                const std::uint32_t first = near.items[n] * kLanes + lane,
                                    place = points.place(first, code);
                const Pack3 p{Pack::load(points.x.data() + place),
                              Pack::load(points.y.data() + place),
                              Pack::load(points.z.data() + place)};
                for (std::uint32_t left = segments; left != 0; left &= left - 1) {
                    const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(left);
                    wait_if_near(group.volume[i], p, first, code, group.waiting[i]);
                    if (group.waiting[i].count + kPackLanes > Waiting::kMost)
                        test(i);
                }
            }
    }
    for (std::size_t i = 0; i < ranks.size(); ++i)
        test(i);
}

void hulls(const ContactPoints& points, Box* hulls, std::size_t first, std::size_t last) {
    const std::size_t count = std::size_t{points.per_section} * kLanes;
    for (std::size_t b = first; b < last; ++b) {
        const auto least_most = [&](const AlignedVector<float>& x, float& least, float& most) {
            const float* at = x.data() + b * count;
            // Points that are nowhere count for neither.
            Pack low(Box::nowhere().low.x), high(Box::nowhere().high.x);
            for (std::size_t i = 0; i < count; i += kPackLanes) {
                const Pack p = Pack::load(at + i);
                low = smaller(low, p);
                high = select(p < Pack(Box::nowhere().low.x), larger(high, p), high);
            }
            least = hn::GetLane(hn::MinOfLanes(Tag(), low.v));
            most = hn::GetLane(hn::MaxOfLanes(Tag(), high.v));
        };
        Box& box = hulls[b];
        least_most(points.x, box.low.x, box.high.x);
        least_most(points.y, box.low.y, box.high.y);
        least_most(points.z, box.low.z, box.high.z);
    }
}

HWY_INLINE hn::Vec<Whole> whole(std::uint32_t x) {
    return hn::Set(Whole(), static_cast<std::int32_t>(x));
}

/// Vectors from wherever they are.
HWY_INLINE Pack3 gather(const AlignedVector<Four>& vectors, hn::Vec<Whole> at) {
    const auto index = hn::ShiftLeft<2>(at);
    const float* base = reinterpret_cast<const float*>(vectors.data());
    return {hn::GatherIndex(Tag(), base, index), hn::GatherIndex(Tag(), base + 1, index),
            hn::GatherIndex(Tag(), base + 2, index)};
}

/// The place of rank · 16 + code.
HWY_INLINE hn::Vec<Whole> place_of(const ContactPoints& points, hn::Vec<Whole> point) {
    const auto low = whole(15);
    const auto bunch = hn::ShiftRight<8>(point), lane = hn::And(hn::ShiftRight<4>(point), low),
               code = hn::And(point, low);
    return hn::Add(hn::ShiftLeft<4>(hn::Add(hn::Mul(bunch, whole(points.per_section)), code)),
                   lane);
}

/// Whether quasi-parallel by one set of limits (M23).
HWY_INLINE Mask parallel(const ParallelLimits& limits, std::size_t i, Pack sine, Pack out,
                         Pack in) {
    const Mask aligned = sine < Pack(limits.sine[i]);
    const Mask no_plane = sine < Pack(limits.sine_fade);
    const Mask leaves = out > larger(Pack(limits.tangent[i]) * in, Pack(limits.speed[i]));
    return {hn::And(aligned.m, hn::Or(no_plane.m, hn::Not(leaves.m)))};
}

void classify(const ContactPoints& points, std::uint32_t rank, const ParallelLimits& limits,
              PointsInside& found) {
    const std::uint32_t next = points.order.next(rank);
    const Pack3 axis = broadcast(first_three(points.direction[rank])),
                near = broadcast(first_three(points.velocity[points.place(rank)])),
                far = broadcast(first_three(points.velocity[points.place(next)]));
    const hn::RebindToUnsigned<Tag> whole;
    for (std::size_t i = 0; i < found.count; i += kPackLanes) {
        const auto real = hn::FirstN(Whole(), found.count - i);
        const auto point = hn::IfThenElseZero(
            real,
            hn::LoadU(Whole(), reinterpret_cast<const std::int32_t*>(found.point.data()) + i));
        const Pack3 n = cross(gather(points.normal, hn::ShiftRight<4>(point)), axis);
        const Pack sine = square_root(dot(n, n));
        const Pack s = hn::LoadU(Tag(), found.s.data() + i);
        const Pack3 v =
            gather(points.velocity, place_of(points, point)) - near * (Pack(1.f) - s) - far * s;
        const Pack3 unit = n * (Pack(1.f) / larger(sine, Pack(1e-30f)));
        const Pack across = dot(v, unit);
        const Pack3 in_plane = v - unit * across;
        const Pack out = absolute(across), in = square_root(dot(in_plane, in_plane));
        const auto flag = [&](std::size_t which, std::uint32_t bit) {
            return hn::IfThenElseZero(
                hn::RebindMask(whole, parallel(limits, which, sine, out, in).m),
                hn::Set(whole, bit));
        };
        hn::StoreU(hn::Or(flag(0, 1), flag(1, 2)), whole, found.parallel.data() + i);
    }
}

PointTest point_test() {
    return {hulls, gather, find, classify};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(point_test);

PointTest point_test_for(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(point_test)();
}

} // namespace mane
#endif
