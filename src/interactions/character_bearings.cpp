#include "interactions/character_bearings.h"

#include "character/box_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mane {
namespace {

constexpr double kNear = 0.01; // [m]

double distance(const Vec3& a, const Vec3& b) {
    return length(Vec3d(a) - Vec3d(b));
}

} // namespace

void CharacterBearings::begin(std::span<CarriedPoint> carried) {
    carried_ = carried;
    came_to_ = wisp_.x;
    known_.assign(carried.size(), {});
    drawn_.resize(wisp_.sections() * (1 + 2 * wisp_.k()));
    drawn_known_.assign(wisp_.sections(), 0);
}

void CharacterBearings::set_free(std::uint32_t i, std::uint32_t b) {
    known_[at(i, b)].inside = Answer::no;
    known_[at(i, b)].segment_free = Answer::yes;
}

const CarriedPoint& CharacterBearings::carried(std::uint32_t i, std::uint32_t b) {
    CarriedPoint& point = carried_[at(i, b)];
    if (!point.settled)
        settle(point, i, *bodies_[b].surface);
    return point;
}

// What was farther off than both went, cannot have been met.
void CharacterBearings::settle(CarriedPoint& carried, std::uint32_t i,
                               const Surface& surface) const {
    const double radius =
        distance(came_to_[i], carried.start) + surface.fastest() * surface.duration() + kNear;
    const Vec3d from(carried.start);
    carried.settled = true;
    if (!carried.found && carried.clear < radius) {
        const auto place = surface.start().nearest(from, radius);
        carried.found = place.has_value();
        carried.clear = place ? std::sqrt(place->closest.squared) : radius;
        if (place)
            carried.triangle = place->triangle;
    }
    carried.near = carried.found && carried.clear <= radius;
    if (carried.near)
        carried.position = Vec3(surface.carried_point(carried.triangle, from));
}

bool CharacterBearings::inside(std::uint32_t i, std::uint32_t b) {
    Answer& known = known_[at(i, b)].inside;
    if (known == Answer::unknown) {
        const bool is = i > 1 && axis_free(i, b) ? inside(i - 1, b) : escape_.inside(wisp_.x[i], b);
        known = is ? Answer::yes : Answer::no;
    }
    return known == Answer::yes;
}

bool CharacterBearings::axis_free(std::uint32_t i, std::uint32_t b) {
    Answer& known = known_[at(i, b)].axis_free;
    if (known == Answer::unknown) {
        const bool is = segment_free(i, b) || escape_.free(b, wisp_.x[i - 1], wisp_.x[i]);
        known = is ? Answer::yes : Answer::no;
    }
    return known == Answer::yes;
}

bool CharacterBearings::segment_free(std::uint32_t i, std::uint32_t b) {
    Answer& known = known_[at(i, b)].segment_free;
    if (known == Answer::unknown)
        known = find_segment_free(i, b) ? Answer::yes : Answer::no;
    return known == Answer::yes;
}

bool CharacterBearings::find_segment_free(std::uint32_t i, std::uint32_t b) {
    const CarriedPoint& carried = this->carried(i, b);
    Extent extent(way_out(i, b));
    extent.add(four(wisp_.x[i - 1]));
    if (carried.near)
        extent.add(four(carried.position));
    add_drawn(i, extent);
    if (WispCopy::simulated(i - 1))
        add_halfway(i, extent);
    return roof(extent, b, extent.lowest).height <= extent.lowest;
}

CharacterBearings::Roof CharacterBearings::section_roof(std::uint32_t i, std::uint32_t b) {
    Extent extent(way_out(i, b));
    add_drawn(i, extent);
    return roof(extent, b, std::numeric_limits<float>::max());
}

CharacterBearings::Roof CharacterBearings::halfway_roof(std::uint32_t i, std::uint32_t b) {
    Extent extent(way_out(i, b));
    add_halfway(i, extent);
    return roof(extent, b, std::numeric_limits<float>::max());
}

/// The axis, the envelope points and the arcs' middles of a section; the latter but for rounding.
std::span<const Four> CharacterBearings::drawn(std::uint32_t i) {
    const std::uint32_t k = wisp_.k();
    const auto places = std::span(drawn_).subspan(i * (1 + 2 * k), 1 + 2 * k);
    if (drawn_known_[i])
        return places;
    const Four centre = four(wisp_.x[i]), share = four(wisp_.half_arc(i, 0).alpha);
    const auto offsets = places.subspan(1, k), arcs = places.subspan(1 + k, k);
    for (std::uint32_t line = 0; line < k; ++line)
        offsets[line] = four(wisp_.d(i, line)) * four(wisp_.r(i, line));
    for (std::uint32_t line = 0; line < k; ++line)
        arcs[line] = centre + (offsets[line] + offsets[wisp_.next(line)]) * share;
    for (Four& place : offsets)
        place += centre;
    places[0] = centre;
    drawn_known_[i] = 1;
    return places;
}

void CharacterBearings::add_drawn(std::uint32_t i, Extent& extent) {
    for (const Four& place : drawn(i))
        extent.add(place);
}

/// WispCopy::halfway of all that is drawn, but for rounding.
void CharacterBearings::add_halfway(std::uint32_t i, Extent& extent) {
    const auto before = drawn(i - 1), here = drawn(i), first = drawn(i - 2),
               last = drawn(std::min(i + 1, wisp_.sections() - 1));
    for (std::size_t n = 0; n < here.size(); ++n)
        extent.add((before[n] + here[n]) * four(9.0f / 16) -
                   (first[n] + last[n]) * four(1.0f / 16));
}

CharacterBearings::Extent::Extent(const Vec3& along)
    : way(along), low(four(std::numeric_limits<float>::max())), high(-low),
      lowest(std::numeric_limits<float>::max()) {}

void CharacterBearings::Extent::add(const Four& point) {
    low = smaller(low, point);
    high = larger(high, point);
    lowest = std::min(lowest, dot(four(way), point));
}

/// Within the box around the points; under the lowest of them it does not matter where. Looks no
/// farther once it is over `enough`.
CharacterBearings::Roof CharacterBearings::roof(const Extent& extent, std::uint32_t b,
                                                float enough) const {
    const Four over = four(kOver);
    const BoxHeights heights(extent.way,
                             {first_three(extent.low - over), first_three(extent.high + over)});
    // also where the way is zero, all heights alike
    const float off = heights.slack + kOver;
    return {extent.way,
            bodies_[b].surface->end().roof(heights, extent.lowest - 2 * off, enough - off) + off};
}

/// From the polygon that was nearest at the block's start, to this section or to one before it:
/// roots are near the skin. Where there was none, any way will do for points that are far off.
Vec3 CharacterBearings::way_out(std::uint32_t i, std::uint32_t b) const {
    std::uint32_t near = i;
    while (near > 1 && carried_[at(near, b)].triangle == PosedSurface::kNoGuess)
        --near;
    const std::uint32_t triangle = carried_[at(near, b)].triangle;
    if (triangle == PosedSurface::kNoGuess)
        return {};
    const Vec3d x(wisp_.x[i]);
    const SurfacePlace place = bodies_[b].surface->end().place_on(triangle, x);
    return Vec3(normalized(x - place.closest.point));
}

void CharacterBearings::forget(std::uint32_t i) {
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
        known_[at(i, b)] = {};
        if (i + 1 < wisp_.sections())
            known_[at(i + 1, b)].axis_free = Answer::unknown;
    }
    forget_envelope(i);
}

// The drawn surface halfway along a segment hangs on the sections before and after its ends too.
void CharacterBearings::forget_envelope(std::uint32_t i) {
    drawn_known_[i] = 0;
    const std::uint32_t end = std::min(i + 3, wisp_.sections());
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
        for (std::uint32_t segment = i - 1; segment < end; ++segment)
            known_[at(segment, b)].segment_free = Answer::unknown;
    }
}

} // namespace mane
