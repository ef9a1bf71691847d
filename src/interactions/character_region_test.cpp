#include "interactions/character_region_test.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "interactions/character_region_test.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// [m] over all rounding in single precision, within metres of the origin.
inline constexpr float kOverRounding = 1e-5f;
/// [m] A region whose plane has been lowered by so much for caution is looked for again.
inline constexpr float kAged = 2e-3f;

HWY_INLINE Pack3 linear(const Vec3& x, const Vec3& y, const Vec3& z, Pack3 p) {
    return {Pack(x.x) * p.x + Pack(y.x) * p.y + Pack(z.x) * p.z,
            Pack(x.y) * p.x + Pack(y.y) * p.y + Pack(z.y) * p.z,
            Pack(x.z) * p.x + Pack(y.z) * p.y + Pack(z.z) * p.z};
}
HWY_INLINE Pack norm(Pack3 v) {
    return square_root(dot(v, v));
}
HWY_INLINE Mask inverse(Mask a) {
    return {hn::Not(a.m)};
}
/// The regions of sixteen sections, where they are at an end of the block.
struct Located {
    Mask known, has_cap, has_ball; // a piece without the centre does not count
    Pack3 centre, normal;
    Pack height, radius, ball, far;
    Pack turn, any; // of their frames
    Pack3 turn_x, turn_y, turn_z, shift;

    HWY_INLINE Pack over(Pack3 p) const { return dot(normal, p) - height; }
    /// Whether all that is over the plane by `over`, and no farther than `out` from the centre, is
    /// in one piece, farther than `above` from its plane and than `margin` from its side.
    HWY_INLINE Mask holds(Pack over, Pack out, Pack above, Pack margin) const {
        const Mask in_cap = both(has_cap, both(over > above, radius - out > margin));
        return either(in_cap, both(has_ball, ball - out > margin));
    }
    /// How far a frame takes a place over the block.
    HWY_INLINE Pack3 way(Pack3 p) const {
        return turn_x * p.x + turn_y * p.y + turn_z * p.z + shift;
    }
};

HWY_INLINE Located located(const RegionQuestion& q, const float* row, int end) {
    const Pack frame = Pack::load(row), zero(0.f);
    const Pack3 centre = Pack3::load(row + ClearRegion::centre * kLanes),
                normal = Pack3::load(row + ClearRegion::normal * kLanes), blank{zero, zero, zero};
    Located found{{hn::Ge(frame.v, zero.v)},
                  {},
                  {},
                  blank,
                  blank,
                  Pack::load(row + ClearRegion::height * kLanes),
                  Pack::load(row + ClearRegion::radius * kLanes),
                  Pack::load(row + ClearRegion::ball * kLanes),
                  Pack::load(row + ClearRegion::far * kLanes),
                  zero,
                  zero,
                  blank,
                  blank,
                  blank,
                  blank};
    for (std::size_t f = 0; f < q.motion.size(); ++f) {
        const Mask here = {hn::Eq(frame.v, Pack(static_cast<float>(f)).v)};
        if (none(here))
            continue;
        const FrameMotion& m = q.motion[f];
        const Pack3 origin = broadcast(m.origin[end]);
        const Pack3 turned = linear(m.x[end], m.y[end], m.z[end], normal);
        found.centre =
            select(here, linear(m.x[end], m.y[end], m.z[end], centre) + origin, found.centre);
        found.normal = select(here, turned, found.normal);
        found.height = select(here, found.height + dot(turned, origin), found.height);
        found.turn = select(here, Pack(m.turn), found.turn);
        found.any = select(here, Pack(m.any), found.any);
        found.turn_x = select(here, broadcast(m.turn_x), found.turn_x);
        found.turn_y = select(here, broadcast(m.turn_y), found.turn_y);
        found.turn_z = select(here, broadcast(m.turn_z), found.turn_z);
        found.shift = select(here, broadcast(m.shift), found.shift);
    }
    const Pack margin(kOverRounding);
    found.has_cap = both(found.over(found.centre) > margin, found.radius > margin);
    found.has_ball = found.ball > margin;
    return found;
}

/// Sixteen sections.
struct Sections {
    Pack3 x;
    Pack radius, rate; ///< the largest
};
HWY_INLINE Sections sections(const RegionQuestion& q, std::size_t row, std::size_t lane) {
    Pack radius(0.f), rate(0.f);
    const float *radii = q.state.radius.row(row) + lane,
                *rates = q.state.radius_rate.row(row) + lane;
    for (std::size_t k = 0; k < q.half_lines.size(); ++k) {
        radius = larger(radius, Pack::load(radii + k * kLanes));
        rate = larger(rate, absolute(Pack::load(rates + k * kLanes)));
    }
    return {Pack3::load(q.state.position.row(row) + lane), radius, rate};
}

/// How far the envelope points of sections come out along a way, from their skeleton points.
struct Heights {
    Pack line[kMaxEnvelopePoints];
};
HWY_INLINE Heights heights(const RegionQuestion& q, std::size_t row, std::size_t lane, Pack3 way) {
    const Pack u = dot(way, Pack3::load(q.frames.u.row(row) + lane)),
               v = dot(way, Pack3::load(q.frames.v.row(row) + lane));
    const float* radii = q.state.radius.row(row) + lane;
    Heights h;
    for (std::size_t k = 0; k < q.half_lines.size(); ++k) {
        const HalfLine& d = q.half_lines[k];
        h.line[k] = Pack::load(radii + k * kLanes) * (u * Pack(d.cosine) + v * Pack(d.sine));
    }
    return h;
}

/// What the half lines have in common.
struct Sector {
    float cosine, inverse; ///< of the angle between neighbours; 1 / (1 − cosine²)
    float longest; ///< no place of the envelope is farther out than this times the largest radius
    explicit Sector(std::span<const HalfLine> lines)
        : cosine(lines[1].cosine), inverse(1 / (1 - lines[1].cosine * lines[1].cosine)),
          longest(lines[1].cosine < 0 ? 1.001f / (1 + lines[1].cosine) : 1.001f) {}
};

/// The lowest of a contact surface (M14a), not over the skeleton point: at an envelope point, or
/// within a sector where it faces down, as in support_point().
HWY_INLINE Pack lowest(const Heights& h, std::size_t count, const Sector& sector) {
    const Pack zero(0.f), c(sector.cosine);
    Pack low = zero, squared = zero;
    for (std::size_t k = 0; k < count; ++k) {
        const Pack a = h.line[k], b = h.line[k + 1 < count ? k + 1 : 0];
        low = smaller(low, a);
        const Mask down = both(a - c * b < zero, b - c * a < zero);
        squared = select(down, larger(squared, a * a + b * b - Pack(2.f) * a * b * c), squared);
    }
    return smaller(low, -square_root(squared * Pack(sector.inverse)));
}

HWY_INLINE Mask live(const Packet& packet, std::size_t i, std::size_t lane) {
    alignas(64) float sections[kPackLanes];
    for (std::size_t l = 0; l < kPackLanes; ++l)
        sections[l] = static_cast<float>(packet.sections[lane + l]);
    return Pack::load(sections) > Pack(static_cast<float>(i));
}

struct Flags {
    Mask section, segment, spent;
};

/// No place that is within `around` of a point, across its section's axis, is farther from another
/// than this. `arm`: from that to the point; `across`: how much of it is across the axis.
HWY_INLINE Pack farthest(Pack3 arm, Pack across, Pack around) {
    return square_root(dot(arm, arm) + (Pack(2.f) * across + around) * around) * Pack(1 + 1e-6f);
}
HWY_INLINE Pack across(const RegionQuestion& q, std::size_t row, std::size_t lane, Pack3 arm) {
    const Pack u = dot(arm, Pack3::load(q.frames.u.row(row) + lane)),
               v = dot(arm, Pack3::load(q.frames.v.row(row) + lane));
    return square_root(u * u + v * v);
}

/// How far off a surface must be, so that hair does not meet it within the block: any place; one
/// below the plane; any that strays as far as the farthest group.
struct Needs {
    Pack any, below, other;
};

// A place of the surface at distance d from a point closes in on it, relative to the frame, by no
// more than the point moves toward it (m·way, with m the unit way there), the surface strays and
// the frame's turn parts them (a share of d). So what is farther than
// (reach + |way| + stray) / (1 − turn) cannot be met. Of a place below the plane, only m·n = −s of
// the distance counts, n the plane's normal: what is over the plane by
// s (reach + max(0, m·way) + stray) / (1 − turn) is clear of it. Of all m, s m·way is largest where
// m halves the angle between −n and the way: (|way| − n·way) / 2. Hair that slides along the
// plane needs half of what hair does that comes straight at it, and hair that leaves needs nothing.
HWY_INLINE Needs needs(const RegionQuestion& q, const Located& region, Pack3 way, Pack stray,
                       Pack further) {
    const Pack length = norm(way), toward = (length - dot(region.normal, way)) * Pack(0.5f);
    const auto need = [&](Pack distance, Pack strays) {
        return Pack(q.share) * (Pack(q.reach) + distance + strays + further) /
               (Pack(1.f) - region.turn);
    };
    return {need(length, stray), need(toward, stray), need(length, region.any)};
}

HWY_INLINE Flags approach_of(const RegionQuestion& q, const Sector& sector, std::size_t row,
                             std::size_t i, std::size_t lane, Mask here) {
    float* numbers = q.region.row(row) + lane;
    const Located region = located(q, numbers, 0);
    const Sections s = sections(q, row, lane), before = sections(q, row - 1, lane);
    const std::size_t count = q.half_lines.size();
    const Pack time(q.duration), longest(sector.longest), half(0.5f), one(1.f), none(0.f);
    const Pack stray = Pack::load(numbers + ClearRegion::stray * kLanes);

    const auto wandered = [&](std::size_t r, Pack3 x) {
        return Pack3::load(q.state.velocity.row(r) + lane) * time - region.way(x);
    };
    const auto needed = [&](Pack3 way, Pack rate, Pack radius) {
        return needs(q, region, way, stray, (rate * time + region.turn * radius) * longest);
    };
    const auto clear = [&](Pack over, Pack out, const Needs& need) {
        return both(region.holds(over, out, need.below, need.any), region.far - out > need.other);
    };

    const Pack3 way = wandered(row, s.x), way_before = wandered(row - 1, before.x);
    const Pack over = region.over(s.x);
    const Pack dip = lowest(heights(q, row, lane, region.normal), count, sector);
    const Pack3 arm = s.x - region.centre;
    const Pack out = farthest(arm, across(q, row, lane, arm), s.radius * longest);
    const Needs need = needed(way, s.rate, s.radius);
    const Mask section_clear = clear(over + dip, out, need);

    const Pack over_before = region.over(before.x);
    const Pack dip_before = lowest(heights(q, row - 1, lane, region.normal), count, sector);
    const Pack radius = (s.radius + before.radius) * half, rate = larger(s.rate, before.rate);
    const Pack3 arm_middle = (s.x + before.x) * half - region.centre;
    const Pack across_middle =
        larger(across(q, row, lane, arm_middle), across(q, row - 1, lane, arm_middle));
    const Mask middle_clear = clear((over + over_before + dip + dip_before) * half,
                                    farthest(arm_middle, across_middle, radius * longest),
                                    needed((way + way_before) * half, rate, radius));

    const Pack margin(kOverRounding), off = norm(arm);
    const Mask holds = both(
        region.known, both(region.holds(over, off, margin, margin), region.far - off > margin));
    select(holds, Pack::load(numbers), Pack(-1.f)).store(numbers);

    const Pack half_segment = norm(s.x - before.x) * half;
    const Pack left =
        smaller(larger(region.radius, region.ball) - need.any, region.far - need.other) - out;
    const Mask fit = both(both(holds, left > (i >= 2 ? half_segment : none)),
                          Pack::load(numbers + ClearRegion::age * kLanes) < Pack(kAged));
    const Mask useful = both(holds, both(section_clear, middle_clear));
    float* pause = numbers + ClearRegion::pause * kLanes;
    select(useful, none, Pack::load(pause)).store(pause);
    // one that was lost is looked for at once: the section is elsewhere
    const Mask lost = both(region.known, inverse(holds));
    const Pack wait =
        select(lost, none, larger(Pack::load(numbers + ClearRegion::wait * kLanes) - one, none));
    wait.store(numbers + ClearRegion::wait * kLanes);
    const Mask may_look = {hn::Eq(wait.v, none.v)};
    const Mask spent = both(both(here, may_look), inverse(either(useful, fit)));
    if (i < 2) {
        const Mask no = both(here, inverse(here));
        return {no, no, spent};
    }
    return {both(here, inverse(both(holds, section_clear))),
            both(here, inverse(both(holds, middle_clear))), spent};
}

void approach(const RegionQuestion& q, std::size_t packet_index, RegionTest::Approach* rows) {
    const Packet& packet = q.layout.packets()[packet_index];
    const Sector sector(q.half_lines);
    rows[0] = {};
    for (std::size_t i = 1; i < packet.rows; ++i) {
        std::uint32_t section = 0, segment = 0, spent = 0;
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes) {
            const Flags flags =
                approach_of(q, sector, packet.first_row + i, i, lane, live(packet, i, lane));
            section |= bits_of(flags.section) << lane;
            segment |= bits_of(flags.segment) << lane;
            spent |= bits_of(flags.spent) << lane;
        }
        rows[i] = {static_cast<std::uint16_t>(section), static_cast<std::uint16_t>(segment),
                   static_cast<std::uint16_t>(spent)};
    }
}

HWY_INLINE void take_end(const Located& at, float* numbers) {
    const Pack stray = Pack::load(numbers + ClearRegion::stray * kLanes);
    const auto add = [&](ClearRegion::Column column, Pack change) {
        (Pack::load(numbers + column * kLanes) + change).store(numbers + column * kLanes);
    };
    add(ClearRegion::height, stray);
    add(ClearRegion::radius, -stray);
    add(ClearRegion::ball, -stray);
    add(ClearRegion::far, -at.any);
    add(ClearRegion::age, stray);
}

/// Weights of the Catmull-Rom curve halfway: WispCopy::halfway.
HWY_INLINE Pack halfway(Pack first, Pack before, Pack here, Pack last) {
    return (before + here) * Pack(9.f / 16) - (first + last) * Pack(1.f / 16);
}

HWY_INLINE Mask stays(const RegionQuestion& q, const Sector& sector, std::size_t first_row,
                      std::size_t i, std::size_t rows, std::size_t lane, Mask goes_on) {
    const std::size_t row = first_row + i, count = q.half_lines.size();
    float* numbers = q.region.row(row) + lane;
    take_end(located(q, numbers, 1), numbers);
    const Located region = located(q, numbers, 1);
    const Pack margin(kOverRounding), half(0.5f), longest(sector.longest);
    const auto holds = [&](Pack over, Pack3 p, Pack around) {
        const Pack out = norm(p - region.centre) + around;
        return both(region.holds(over, out, margin, margin), region.far - out > margin);
    };

    const Sections s = sections(q, row, lane);
    const Pack over = region.over(s.x);
    const Heights h = heights(q, row, lane, region.normal);
    const Pack none(0.f);
    Mask all = region.known;
    if (i == 1)
        all = both(all, holds(over, s.x, none));
    else
        all = both(all, holds(over + lowest(h, count, sector), s.x, s.radius * longest));

    Sections last = s;
    if (i + 1 < rows) {
        const Sections after = sections(q, row + 1, lane);
        last = {select(goes_on, after.x, s.x), select(goes_on, after.radius, s.radius), none};
        all = both(all, holds((over + region.over(last.x)) * half, (s.x + last.x) * half, none));
    }
    if (i < 2)
        return all;
    const Sections before = sections(q, row - 1, lane);
    const Pack over_before = region.over(before.x);
    all = both(all, holds((over + over_before) * half, (s.x + before.x) * half, none));
    if (i < 3)
        return all;

    const Sections first = sections(q, row - 2, lane);
    const Heights h_first = heights(q, row - 2, lane, region.normal),
                  h_before = heights(q, row - 1, lane, region.normal);
    Heights h_last = h;
    if (i + 1 < rows) {
        const Heights after = heights(q, row + 1, lane, region.normal);
        for (std::size_t k = 0; k < count; ++k)
            h_last.line[k] = select(goes_on, after.line[k], h.line[k]);
    }
    Heights between;
    for (std::size_t k = 0; k < count; ++k)
        between.line[k] = halfway(h_first.line[k], h_before.line[k], h.line[k], h_last.line[k]);
    const Pack middle_arc = Pack(1.f) / square_root(Pack(2 + 2 * sector.cosine));
    Pack low = none;
    for (std::size_t k = 0; k < count; ++k) {
        const Pack a = between.line[k], b = between.line[k + 1 < count ? k + 1 : 0];
        low = smaller(low, smaller(a, (a + b) * middle_arc));
    }
    const Pack3 middle{halfway(first.x.x, before.x.x, s.x.x, last.x.x),
                       halfway(first.x.y, before.x.y, s.x.y, last.x.y),
                       halfway(first.x.z, before.x.z, s.x.z, last.x.z)};
    const Pack around =
        (before.radius + s.radius) * Pack(9.f / 16) + (first.radius + last.radius) * Pack(1.f / 16);
    return both(all, holds(region.over(middle) + low, middle, around * longest));
}

void stay(const RegionQuestion& q, std::size_t packet_index, std::uint16_t* rows) {
    const Packet& packet = q.layout.packets()[packet_index];
    const Sector sector(q.half_lines);
    for (std::size_t i = 1; i < packet.rows; ++i) {
        std::uint32_t bits = 0;
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
            bits |= bits_of(stays(q, sector, packet.first_row, i, packet.rows, lane,
                                  live(packet, i + 1, lane)))
                    << lane;
        rows[i] = static_cast<std::uint16_t>(bits);
    }
}

RegionTest region_test() {
    return {approach, stay};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(region_test);

RegionTest region_test_for(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(region_test)();
}

} // namespace mane
#endif
