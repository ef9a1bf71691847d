#include "interactions/character_escape.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr double kJustOver =
    1e-5; // [m] over a surface: clear of the rounding of floats a metre from the origin
constexpr double kFar = 1e3; // [m] more than any body

} // namespace

bool Escape::inside(const Vec3& p, std::span<const std::uint8_t> exempt) const {
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
        if (!exempt[b] && inside(p, b))
            return true;
    }
    return false;
}

Escape::Entry Escape::entry_at(std::uint32_t b, const Crossing& crossing, const Vec3d& from,
                               const Vec3d& to) const {
    const Vec3d point = from + (to - from) * crossing.at;
    return {pose(b).place_on(crossing.triangle, point), crossing.at};
}

std::optional<Escape::Entry> Escape::entry(std::uint32_t b, const Vec3& from, const Vec3& to) {
    const Vec3d start(from), end(to);
    pose(b).crossings(start, end, crossings_);
    for (const Crossing& crossing : crossings_) {
        if (crossing.sign > 0)
            return entry_at(b, crossing, start, end);
    }
    return {};
}

std::optional<Escape::Entry> Escape::entry_to_stay(std::uint32_t b, const Vec3& from,
                                                   const Vec3& to) {
    const std::optional<Entry> first = entry(b, from, to);
    int sum = 0;
    for (const Crossing& crossing : crossings_)
        sum += crossing.sign;
    return sum > 0 ? first : std::nullopt;
}

std::optional<float> Escape::middle_of_stretch(std::uint32_t b, const Vec3& from, const Vec3& to) {
    pose(b).crossings(Vec3d(from), Vec3d(to), crossings_);
    std::optional<float> middle;
    double longest = 0, entered = 0;
    int winding = 0;
    for (const Crossing& crossing : crossings_) {
        if (winding == 0)
            entered = crossing.at;
        winding += crossing.sign;
        if (winding != 0 || crossing.at - entered <= longest)
            continue;
        longest = crossing.at - entered;
        middle = static_cast<float>((crossing.at + entered) / 2);
    }
    return middle;
}

Vec3d Escape::outward(std::uint32_t b, const SurfacePlace& place, const Vec3d& inside) const {
    const Vec3d normal = pose(b).normal(place.triangle);
    const Vec3d way = place.closest.point - inside;
    const double size = length(way);
    return size > kJustOver && dot(way, normal) > 0.5 * size ? way / size : normal;
}

// Surfaces inside the union (a neck that goes on inside the chest) are nearer than the way out at
// times: they do not count.
std::optional<SurfacePlace> Escape::exit(std::uint32_t b, const Vec3& p) const {
    const Vec3d from(p);
    return pose(b).nearest_accepted(from, kFar, [&](const SurfacePlace& place) {
        return !pose(b).inside(place.closest.point + outward(b, place, from) * kJustOver);
    });
}

Vec3 Escape::over(std::uint32_t b, const SurfacePlace& place, const Vec3& inside, double height) {
    const Vec3d way = outward(b, place, Vec3d(inside));
    const Vec3d start = place.closest.point + way * (kJustOver / 2);
    pose(b).crossings(start, place.closest.point + way * (2 * height), crossings_);
    if (!crossings_.empty())
        height = std::min(height, crossings_[0].at * height);
    return Vec3(place.closest.point + way * height);
}

} // namespace mane
