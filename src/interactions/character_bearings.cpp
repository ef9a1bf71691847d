#include "interactions/character_bearings.h"

namespace mane {
namespace {

/// [m] far over the rounding of distances in double, far under what shows.
constexpr double kRounding = 1e-9;

double distance(const Vec3& a, const Vec3& b) {
    return length(Vec3d(a) - Vec3d(b));
}

} // namespace

CharacterBearings::CharacterBearings(const WispCopy& wisp, std::span<const ContactBody> bodies,
                                     std::span<const CarriedPoint> carried, const Escape& escape)
    : wisp_(wisp), bodies_(bodies), carried_(carried), escape_(escape), known_(carried.size()) {}

// A place of the surface goes no farther over the block than the vertices of its triangle.
double CharacterBearings::clear(std::uint32_t i, std::uint32_t b, const Vec3& p,
                                float enough) const {
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
        const bool is =
            clear_way(i, b, before, clear(i - 1, b)) || escape_.free(b, before, wisp_.x[i]);
        known = is ? Answer::yes : Answer::no;
    }
    return known == Answer::yes;
}

void CharacterBearings::forget(std::uint32_t i) {
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
        known_[at(i, b)] = {};
        if (i + 1 < wisp_.sections())
            known_[at(i + 1, b)].axis_free = Answer::unknown;
    }
}

} // namespace mane
