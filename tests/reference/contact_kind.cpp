/// §4.1: "If the orientations of the two wisp segments lie in the same plane, and if their relative
/// velocity is also roughly in this plane, wisps are allowed to interpenetrate."

#include "reference/interactions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mane::reference {
namespace {

double sine_of(double degrees) {
    return std::sin(degrees * std::numbers::pi / 180);
}

Vec3d axis_direction(const Hair& hair, const Site& segment) {
    const Wisp& wisp = hair.wisps[segment.wisp];
    return normalized(wisp.x[segment.section + 1] - wisp.x[segment.section]);
}

Vec3d axis_velocity(const Hair& hair, const Site& segment, double s) {
    const Wisp& wisp = hair.wisps[segment.wisp];
    return (1 - s) * wisp.v[segment.section] + s * wisp.v[segment.section + 1];
}

} // namespace

Frames all_frames(const Hair& hair) {
    Frames frames;
    for (const Wisp& wisp : hair.wisps)
        frames.push_back(section_frames(wisp));
    return frames;
}

Side point_side(const Hair& hair, const Frames& frames, const Contact& contact) {
    const auto [w, i] = contact.point;
    if (contact.k == Contact::kAxis)
        return {axis_direction(hair, contact.point),
                axis_velocity(hair, contact.point, contact.along)};
    const Wisp& wisp = hair.wisps[w];
    Side side = {frames[w][i].n, wisp.v[i]};
    if (contact.k >= 0) {
        const std::size_t k = static_cast<std::size_t>(contact.k);
        side.velocity += wisp.r_rate[i][k] * half_line(frames[w][i], k, wisp.points());
    }
    return side;
}

Side segment_side(const Hair& hair, const Contact& contact) {
    return {axis_direction(hair, contact.segment), axis_velocity(hair, contact.segment, contact.s)};
}

bool quasi_parallel(const Side& p, const Side& s, const WispContactDesc& desc, bool before) {
    const double angle = static_cast<double>(desc.parallel_angle);
    const double wider = before ? static_cast<double>(desc.hysteresis) : 1.0;
    const Vec3d across = cross(p.direction, s.direction);
    const double sine = length(across);
    if (sine >= sine_of(before ? std::min(angle * wider, 89.0) : angle))
        return false;
    if (sine < sine_of(static_cast<double>(desc.fade_angle)))
        return true; // too parallel to have a plane

    const Vec3d n = across / sine, v = p.velocity - s.velocity;
    const double out_of_plane = std::abs(dot(v, n)), in_plane = length(v - dot(v, n) * n);
    const double tangent = std::tan(angle * std::numbers::pi / 180);
    return out_of_plane <=
           wider * std::max(tangent * in_plane, static_cast<double>(desc.sliding_speed));
}

} // namespace mane::reference
