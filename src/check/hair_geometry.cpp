#include "check/hair_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mane::judge {
namespace {

Vec3d direction(const Vec3& from, const Vec3& to) {
    return normalized(Vec3d(to) - Vec3d(from));
}

/// The least rotation that takes one unit vector to another; none where they are opposite and there
/// is no least one.
Quatd least_rotation(const Vec3d& from, const Vec3d& to) {
    const Vec3d axis = cross(from, to);
    const double w = 1 + dot(from, to);
    return w > 1e-9 ? normalized(Quatd{axis.x, axis.y, axis.z, w}) : Quatd{};
}

Vec3d across(const Vec3d& u, const Vec3d& n) {
    return normalized(u - n * dot(u, n));
}

} // namespace

HairGeometry::HairGeometry(const Groom& groom, const Frame& frame)
    : groom_(&groom), frame_(&frame), sections_(groom.section_count()) {
    for (std::uint32_t k = 0; k < points(); ++k) {
        const double angle = 2 * std::numbers::pi * k / points();
        cosine_.push_back(std::cos(angle));
        sine_.push_back(std::sin(angle));
    }
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        const std::size_t first = groom.first_section[w], last = groom.first_section[w + 1] - 1;
        Vec3d before = direction(frame.position[first], frame.position[first + 1]);
        Vec3d n = before, u = across(Vec3d(frame.first_axis[w]), n);
        for (std::size_t s = first; s <= last; ++s) {
            const Vec3d after =
                s < last ? direction(frame.position[s], frame.position[s + 1]) : before;
            const Vec3d sum = before + after;
            const Vec3d bisecting = length(sum) < 1e-3 ? before : normalized(sum);
            u = across(least_rotation(n, bisecting).rotate(u), bisecting);
            n = bisecting;
            sections_[s] = {Vec3d(frame.position[s]), u, cross(n, u), n};
            before = after;
        }
    }
}

double HairGeometry::largest_radius(std::size_t s) const {
    const auto first = frame_->radius.begin() + static_cast<std::ptrdiff_t>(s * points());
    return *std::max_element(first, first + points());
}

Vec3d HairGeometry::half_line(std::size_t s, std::uint32_t k) const {
    return sections_[s].u * cosine_[k] + sections_[s].v * sine_[k];
}

Vec3d HairGeometry::envelope_point(std::size_t s, std::uint32_t k) const {
    return sections_[s].x + half_line(s, k) * radius(s, k);
}

double section_area(const std::vector<float>& radii, std::size_t s, std::uint32_t points) {
    // A sector between two half lines at an angle is the linear image of a sector of the unit disc.
    double sum = 0;
    for (std::uint32_t k = 0; k < points; ++k)
        sum += double{radii[s * points + k]} * double{radii[s * points + (k + 1) % points]};
    return sum * std::numbers::pi / points;
}

double kinetic_energy(const Groom& groom, const Frame& frame, const HairGeometry& hair,
                      std::size_t s) {
    const Vec3d v(frame.velocity[s]);
    double twice = groom.skeleton_mass[s] * dot(v, v);
    for (std::uint32_t k = 0; k < hair.points(); ++k) {
        const double rate = frame.radius_rate[s * hair.points() + k];
        const Vec3d at = v + hair.half_line(s, k) * rate;
        twice += groom.envelope_mass[s] * dot(at, at);
    }
    return twice / 2;
}

std::uint32_t wisp_of(const Groom& groom, std::size_t section) {
    const auto behind =
        std::upper_bound(groom.first_section.begin(), groom.first_section.end(), section);
    return static_cast<std::uint32_t>(behind - groom.first_section.begin() - 1);
}

} // namespace mane::judge
