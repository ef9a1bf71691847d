#include "interactions/axis_test.h"

#include "interactions/point_test.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

/// The closest points of two segments' axes, as places along them; only where both lie inside.
struct ClosestPoints {
    float s = 0, t = 0;
    bool inside = false;
};
ClosestPoints closest_points(const Vec3& a0, const Vec3& a1, const Vec3& b0, const Vec3& b1) {
    const Vec3 d = a1 - a0, e = b1 - b0, r = a0 - b0;
    const float dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dr = dot(d, r), er = dot(e, r);
    const float det = dd * ee - de * de;
    if (!(det > 0))
        return {};
    const float s = (de * er - ee * dr) / det, t = (dd * er - de * dr) / det;
    return {s, t, s > 0 && s < 1 && t > 0 && t < 1};
}

/// The square of the depth of section coordinates (a, b): quarter-ellipses between neighbouring
/// half lines, or their like for other K (M14a). The sector of (a, b) is the one in which both
/// coordinates along its two half lines are not negative; the largest smaller coordinate finds it
/// without branches on signs of zeros.
float squared_depth(const ContactPoints& points, const SectionShape& section, float a, float b) {
    const std::uint32_t k_count = points.per_section - 1;
    const auto radius = [&](std::uint32_t line) {
        return std::max(section.radius[line], kSmallestRadius);
    };
    if (k_count == 4) { // the paper's four: the signs tell the quadrant
        const float p = a / radius(a < 0 ? 2 : 0), q = b / radius(b < 0 ? 3 : 1);
        return p * p + q * q;
    }
    const float sine = points.half_lines[1].sine, cosine = points.half_lines[1].cosine;
    float best = 0, result = 0;
    for (std::uint32_t k = 0; k < k_count; ++k) {
        const std::uint32_t next = k + 1 < k_count ? k + 1 : 0;
        const HalfLine &d = points.half_lines[k], &e = points.half_lines[next];
        // (a, b) = α d + β e, solved by cross products
        const float alpha = (a * e.sine - b * e.cosine) / sine,
                    beta = (d.cosine * b - d.sine * a) / sine;
        const float smaller = std::min(alpha, beta);
        if (k > 0 && smaller <= best)
            continue;
        best = smaller;
        const float p = alpha / radius(k), q = beta / radius(next);
        result = p * p + q * q + 2 * p * q * cosine;
    }
    return result;
}

/// The radius of a section in a direction's part in the section.
float radius_of(const ContactPoints& points, const SectionShape& section, const Vec3& way) {
    const float a = dot(way, section.u), b = dot(way, section.v);
    const float d2 = squared_depth(points, section, a, b);
    return d2 > 0 ? std::sqrt((a * a + b * b) / d2) : 0.f;
}

/// A segment by its two sections.
struct Segment {
    const SectionShape &near, &far;

    Segment(const ContactPoints& points, std::uint32_t rank)
        : near(points.shape[rank]), far(points.shape[points.order.next(rank)]) {}

    Vec3 at(float s) const { return near.x + (far.x - near.x) * s; }
    float radius_toward(const ContactPoints& points, float s, const Vec3& way) const {
        return radius_of(points, near, way) * (1 - s) + radius_of(points, far, way) * s;
    }
    float density_at(float s) const {
        const auto mixed = [s](float a, float b) { return a + (b - a) * s; };
        return std::min(mixed(near.rest_area, far.rest_area) /
                            std::max(mixed(near.area, far.area), 1e-12f),
                        10.f);
    }
};

} // namespace

std::optional<AxisContact> axis_contact(const ContactPoints& points, std::uint32_t first,
                                        std::uint32_t second) {
    const Segment a(points, first), b(points, second);
    const ClosestPoints c = closest_points(a.near.x, a.far.x, b.near.x, b.far.x);
    if (!c.inside)
        return {};
    const Vec3 gap = b.at(c.t) - a.at(c.s);
    const float touching = a.radius_toward(points, c.s, gap) + b.radius_toward(points, c.t, -gap);
    const float distance = length(gap);
    if (distance > touching)
        return {};
    // Axes that meet in a point leave no way toward each other.
    return AxisContact{c.s, c.t, touching > 0 ? distance / touching : 0.f, b.density_at(c.t)};
}

} // namespace mane
