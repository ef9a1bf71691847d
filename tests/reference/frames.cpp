/// §3.3: "the cross-section lies in the plane bisecting the two skeleton segments adjacent to that
/// point-mass", and "we attach the first local frame to the head [and] define the other local
/// frames using the quaternion that minimally rotates a given cross section plane onto the next
/// one".

#include "reference/twin.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mane::reference {
namespace {

/// M7.
Vec3d section_normal(const Wisp& wisp, std::size_t i) {
    const std::size_t tip = wisp.sections() - 1;
    if (i == 0)
        return segment_direction(wisp, 0);
    if (i == tip)
        return segment_direction(wisp, tip - 1);
    const Vec3d before = segment_direction(wisp, i - 1), after = segment_direction(wisp, i);
    const Vec3d sum = before + after;
    // Folded back on itself the wisp has no bisecting plane.
    return length(sum) < 1e-3 ? before : normalized(sum);
}

/// M8: u turned by the least rotation that takes unit vector `from` to `to`.
Vec3d carried(const Vec3d& u, const Vec3d& from, const Vec3d& to) {
    const double denominator = std::max(1 + dot(from, to), 1e-6);
    return u - dot(u, to) / denominator * (from + to);
}

Vec3d unit_across(const Vec3d& u, const Vec3d& n) {
    return normalized(u - dot(u, n) * n);
}

} // namespace

std::vector<SectionFrame> section_frames(const Wisp& wisp) {
    std::vector<SectionFrame> frames(wisp.sections());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Vec3d n = section_normal(wisp, i);
        const Vec3d u = i == 0 ? wisp.u0 : carried(frames[i - 1].u, frames[i - 1].n, n);
        frames[i].n = n;
        frames[i].u = unit_across(u, n);
        frames[i].v = cross(n, frames[i].u);
    }
    return frames;
}

Vec3d half_line(const SectionFrame& frame, std::size_t k, std::size_t points) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(points);
    return std::cos(angle) * frame.u + std::sin(angle) * frame.v;
}

} // namespace mane::reference
