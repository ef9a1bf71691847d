#include "interactions/point_test.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "interactions/point_test.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

HWY_INLINE Pack3 broadcast(const Vec3& v) {
    return {Pack(v.x), Pack(v.y), Pack(v.z)};
}
HWY_INLINE Mask both(Mask a, Mask b) {
    return {hn::And(a.m, b.m)};
}
HWY_INLINE Mask neither(Mask a, Mask b) {
    return {hn::Not(hn::Or(a.m, b.m))};
}
HWY_INLINE bool none(Mask m) {
    return hn::AllFalse(Tag(), m.m);
}

HWY_INLINE Mask in_box(const Box& box, const Pack3& p) {
    const Mask x = neither(p.x<Pack(box.low.x), p.x> Pack(box.high.x)),
               y = neither(p.y<Pack(box.low.y), p.y> Pack(box.high.y)),
               z = neither(p.z<Pack(box.low.z), p.z> Pack(box.high.z));
    return both(x, both(y, z));
}

HWY_INLINE Pack mixed(float a, float b, Pack s) {
    return Pack(a) + Pack(b - a) * s;
}
HWY_INLINE Pack3 mixed(const Vec3& a, const Vec3& b, Pack s) {
    return {mixed(a.x, b.x, s), mixed(a.y, b.y, s), mixed(a.z, b.z, s)};
}
HWY_INLINE Pack radius_at(const SegmentVolume& v, std::size_t k, Pack s) {
    return larger(mixed(v.end[0].radius[k], v.end[1].radius[k], s), Pack(kSmallestRadius));
}

/// The square of the depth of section coordinates (a, b) at s (M14a).
HWY_INLINE Pack squared_depth_at(const SegmentVolume& volume, std::span<const HalfLine> half_lines,
                                 Pack a, Pack b, Pack s) {
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
HWY_INLINE Inside inside(const SegmentVolume& volume, std::span<const HalfLine> half_lines,
                         const Pack3& p, Mask boxed) {
    const VolumeEnd &a = volume.end[0], &b = volume.end[1];
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
    const VolumeEnd &a = volume.end[0], &b = volume.end[1];
    return smaller(mixed(a.rest_area, b.rest_area, s) /
                       larger(mixed(a.area, b.area, s), Pack(1e-12f)),
                   Pack(10.f));
}

HWY_INLINE Mask overlap(const BoxTree::Node& node, std::size_t lane, const Box& box) {
    const Mask low = neither({hn::Or((Pack::load(node.low_x + lane) > Pack(box.high.x)).m,
                                     (Pack::load(node.low_y + lane) > Pack(box.high.y)).m)},
                             Pack::load(node.low_z + lane) > Pack(box.high.z));
    const Mask high = neither({hn::Or((Pack::load(node.high_x + lane) < Pack(box.low.x)).m,
                                      (Pack::load(node.high_y + lane) < Pack(box.low.y)).m)},
                              Pack::load(node.high_z + lane) < Pack(box.low.z));
    return both(low, high);
}

/// One bit per lane.
HWY_INLINE std::uint32_t bits_of(Mask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask.m, bytes);
    return bytes[0] | std::uint32_t{bytes[1]} << 8;
}
HWY_INLINE std::uint32_t children_in(const BoxTree::Node& node, const Box& box) {
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
        bits |= bits_of(overlap(node, lane, box)) << lane;
    return bits;
}

std::size_t overlapping(const BoxTree& tree, const Box& box, std::uint32_t* items,
                        std::size_t capacity) {
    struct Visit {
        std::uint32_t node, left; // of its children in the box, those not yet visited
    };
    constexpr std::size_t kMostLevels = 9; // of a tree of 2³² boxes, and one
    Visit stack[kMostLevels];
    std::size_t count = 0;
    if (tree.levels() == 0)
        return 0;
    const std::size_t top = tree.levels() - 1;
    std::size_t level = top;
    stack[top] = {0, children_in(tree.node(top, 0), box)};
    for (;;) {
        Visit& now = stack[level];
        if (now.left == 0) {
            if (level == top)
                return count;
            ++level;
            continue;
        }
        const auto child = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(now.left));
        now.left &= now.left - 1;
        if (level == 0) {
            if (count < capacity)
                items[count] = tree.item(now.node, child);
            ++count;
        } else {
            const std::uint32_t node = now.node * kLanes + child;
            --level;
            stack[level] = {node, children_in(tree.node(level, node), box)};
        }
    }
}

/// Points that wait for the test: those in the box, a few vectors of them.
struct Waiting {
    static constexpr std::size_t kMost = 256;
    alignas(64) float x[kMost + kLanes], y[kMost + kLanes], z[kMost + kLanes];
    std::int32_t point[kMost + kLanes];
    std::size_t count = 0;
};

HWY_INLINE void wait_if_boxed(const SegmentVolume& volume, const SectionPoints& points,
                              std::uint32_t section, Waiting& waiting) {
    const Tag tag;
    const hn::RebindToSigned<Tag> integers;
    for (std::uint32_t c = 0; c < points.per_section; c += static_cast<std::uint32_t>(kPackLanes)) {
        const std::uint32_t first = section * points.per_section + c;
        const Pack3 p{hn::LoadU(tag, points.x + first), hn::LoadU(tag, points.y + first),
                      hn::LoadU(tag, points.z + first)};
        const auto of_section = hn::FirstN(tag, points.per_section - c);
        const Mask boxed = both({of_section}, in_box(volume.box, p));
        if (none(boxed))
            continue;
        hn::CompressStore(p.x.v, boxed.m, tag, waiting.x + waiting.count);
        hn::CompressStore(p.y.v, boxed.m, tag, waiting.y + waiting.count);
        hn::CompressStore(p.z.v, boxed.m, tag, waiting.z + waiting.count);
        waiting.count += hn::CompressStore(hn::Iota(integers, static_cast<std::int32_t>(first)),
                                           hn::RebindMask(integers, boxed.m), integers,
                                           waiting.point + waiting.count);
    }
}

std::size_t test_waiting(const SegmentVolume& volume, std::span<const HalfLine> half_lines,
                         Waiting& waiting, PointInside* found) {
    std::size_t count = 0;
    for (std::size_t first = 0; first < waiting.count; first += kPackLanes) {
        const Pack3 p{Pack::load(waiting.x + first), Pack::load(waiting.y + first),
                      Pack::load(waiting.z + first)};
        const Mask real = {hn::FirstN(Tag(), waiting.count - first)};
        const Inside in = inside(volume, half_lines, p, real);
        std::uint32_t bits = bits_of(in.holds);
        if (bits == 0)
            continue;
        alignas(64) float s[kPackLanes], depth[kPackLanes], density[kPackLanes];
        in.s.store(s);
        in.depth.store(depth);
        density_at(volume, in.s).store(density);
        for (; bits != 0; bits &= bits - 1) {
            const std::size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero32(bits);
            found[count++] = {static_cast<std::uint32_t>(waiting.point[first + i]), s[i], depth[i],
                              density[i]};
        }
    }
    waiting.count = 0;
    return count;
}

std::size_t find(const SegmentVolume& volume, std::span<const HalfLine> half_lines,
                 const SectionPoints& points, std::span<const std::uint32_t> sections,
                 PointInside* found) {
    std::size_t count = 0;
    Waiting waiting;
    for (const std::uint32_t section : sections) {
        wait_if_boxed(volume, points, section, waiting);
        if (waiting.count + points.per_section > Waiting::kMost)
            count += test_waiting(volume, half_lines, waiting, found + count);
    }
    return count + test_waiting(volume, half_lines, waiting, found + count);
}

PointTest point_test() {
    return {overlapping, find};
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
