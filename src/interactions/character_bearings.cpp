#include "interactions/character_bearings.h"

#include "character/box_tests.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

/// [m] far over the rounding of distances in double, far under what shows.
constexpr double kRounding = 1e-9;
constexpr double kNear = 0.01; // [m]

double distance(const Vec3& a, const Vec3& b) {
    return length(Vec3d(a) - Vec3d(b));
}

} // namespace

CharacterBearings::CharacterBearings(const WispCopy& wisp, std::span<const ContactBody> bodies,
                                     std::span<CarriedPoint> carried, const Escape& escape)
    : wisp_(wisp), bodies_(bodies), carried_(carried), escape_(escape), came_to_(wisp.x),
      known_(carried.size()), drawn_(wisp.sections() * (1 + 2 * wisp.k())),
      drawn_known_(wisp.sections(), 0) {}

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
        const auto place = surface.start().nearest(from, radius, carried.triangle);
        carried.found = place.has_value();
        carried.clear = place ? std::sqrt(place->closest.squared) : radius;
        if (place)
            carried.triangle = place->triangle;
    }
    carried.near = carried.found && carried.clear <= radius;
    if (carried.near)
        carried.position = Vec3(surface.carried_point(carried.triangle, from));
}

// A place of the surface goes no farther over the block than the vertices of its triangle.
double CharacterBearings::clear(std::uint32_t i, std::uint32_t b, const Vec3& p, float enough) {
    const CarriedPoint& carried = carried_[at(i, b)];
    const Surface& surface = *bodies_[b].surface;
    const double left = carried.clear - distance(p, carried.start) -
                        surface.fastest() * surface.duration() - kRounding;
    return left >= double(enough) ? left : escape_.distance(b, p, double(enough), carried.triangle);
}

double CharacterBearings::clear(std::uint32_t i, std::uint32_t b) {
    double& known = known_[at(i, b)].clear;
    if (known < 0)
        known = clear(i, b, wisp_.x[i], enough(i));
    return known;
}

bool CharacterBearings::inside(std::uint32_t i, std::uint32_t b) {
    Answer& known = known_[at(i, b)].inside;
    if (known == Answer::unknown) {
        const bool is = i > 1 && axis_free(i, b) ? inside(i - 1, b) : escape_.inside(wisp_.x[i], b);
        known = is ? Answer::yes : Answer::no;
    }
    return known == Answer::yes;
}

bool CharacterBearings::inside(std::uint32_t i, std::uint32_t b, const Vec3& p, double clear_ball) {
    return clear_way(i, b, p, clear_ball) ? inside(i, b) : escape_.inside(p, b);
}

bool CharacterBearings::clear_way(std::uint32_t i, std::uint32_t b, const Vec3& p,
                                  double clear_ball) {
    return distance(wisp_.x[i], p) + kRounding < clear(i, b) + clear_ball;
}

bool CharacterBearings::axis_free(std::uint32_t i, std::uint32_t b) {
    Answer& known = known_[at(i, b)].axis_free;
    if (known == Answer::unknown) {
        const Vec3& before = wisp_.x[i - 1];
        const bool is = segment_free(i, b) || clear_way(i, b, before, clear(i - 1, b)) ||
                        escape_.free(b, before, wisp_.x[i]);
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
    points_.assign({wisp_.x[i - 1], wisp_.x[i]});
    if (carried.near)
        points_.push_back(carried.position);
    const auto here = drawn(i);
    points_.insert(points_.end(), here.begin(), here.end());
    if (WispCopy::simulated(i - 1))
        add_halfway(i);
    return clear_of_points(b, way_out(i, b));
}

/// The axis, the envelope points and the arcs' middles of a section.
std::span<const Vec3> CharacterBearings::drawn(std::uint32_t i) {
    const std::size_t count = 1 + 2 * wisp_.k();
    const auto places = std::span(drawn_).subspan(i * count, count);
    if (!drawn_known_[i]) {
        places[0] = wisp_.x[i];
        for (std::uint32_t line = 0; line < wisp_.k(); ++line) {
            places[1 + 2 * line] = wisp_.position({i, 0, line, 1, 0});
            places[2 + 2 * line] = wisp_.position(wisp_.half_arc(i, line));
        }
        drawn_known_[i] = 1;
    }
    return places;
}

/// WispCopy::halfway of all that is drawn, but for rounding.
void CharacterBearings::add_halfway(std::uint32_t i) {
    const auto before = drawn(i - 1), here = drawn(i), first = drawn(i - 2),
               last = drawn(std::min(i + 1, wisp_.sections() - 1));
    for (std::size_t n = 0; n < here.size(); ++n)
        points_.push_back((before[n] + here[n]) * (9.0f / 16) - (first[n] + last[n]) * (1.0f / 16));
}

bool CharacterBearings::clear_of_points(std::uint32_t b, const Vec3& way) const {
    TriangleTree::Box box{points_[0], points_[0]};
    float lowest = dot(way, points_[0]);
    for (const Vec3& p : points_) {
        box = both(box, {p, p});
        lowest = std::min(lowest, dot(way, p));
    }
    const Vec3 over(kOver, kOver, kOver);
    const BoxHeights heights(way, {box.low - over, box.high + over});
    lowest -= heights.slack + kOver; // also where the way is zero, all heights alike
    return bodies_[b].surface->end().roof(heights, lowest, lowest) <= lowest;
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
    const ClosestPoint closest =
        closest_on_triangle(x, bodies_[b].surface->end().triangle(triangle));
    return Vec3(normalized(x - closest.point));
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
