#include "interactions/segments.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mane {
namespace {

// [m] rounding must not leave a section's own envelope point outside its segment's box, or the grid
// could miss it
constexpr float kBoxMargin = 1e-5f;
constexpr float kSmallestRadius = 1e-6f; // [m] a section squeezed flat still has a depth everywhere

float area_of(std::span<const float> radii) {
    float sum = 0;
    for (std::size_t k = 0; k < radii.size(); ++k)
        sum += radii[k] * radii[k + 1 < radii.size() ? k + 1 : 0];
    return sum;
}

/// Half the size, per world axis, of a disc of radius r.
Vec3 disc_extent(const Vec3& n, float r) {
    const auto side = [r](float c) { return r * std::sqrt(std::max(0.f, 1 - c * c)); };
    return {side(n.x), side(n.y), side(n.z)};
}

} // namespace

float squared_depth(std::span<const HalfLine> half_lines, std::span<const float> radii, float a,
                    float b) {
    if (radii.size() == 4) { // the paper's four: the signs tell the quadrant
        const float p = a / std::max(radii[a < 0 ? 2 : 0], kSmallestRadius),
                    q = b / std::max(radii[b < 0 ? 3 : 1], kSmallestRadius);
        return p * p + q * q;
    }
    // The sector of (a, b) is the one in which both coordinates along its two half lines are not
    // negative; the largest smaller coordinate finds it without branches on signs of zeros.
    const std::size_t k_count = radii.size();
    const float sine = half_lines[1].sine, cosine = half_lines[1].cosine;
    float best = -1, result = 0;
    for (std::size_t k = 0; k < k_count; ++k) {
        const std::size_t next = k + 1 < k_count ? k + 1 : 0;
        const HalfLine& d = half_lines[k];
        const HalfLine& e = half_lines[next];
        // (a, b) = α d + β e, solved by cross products
        const float alpha = (a * e.sine - b * e.cosine) / sine,
                    beta = (d.cosine * b - d.sine * a) / sine;
        const float smaller = std::min(alpha, beta);
        if (k > 0 && smaller <= best)
            continue;
        best = smaller;
        const float p = alpha / std::max(radii[k], kSmallestRadius),
                    q = beta / std::max(radii[next], kSmallestRadius);
        result = p * p + q * q + 2 * p * q * cosine;
    }
    return result;
}

void ContactGeometry::find_segments(const HairView& hair) {
    k_ = hair.groom.envelope_points;
    half_lines_.assign(hair.half_lines.begin(), hair.half_lines.end());
    sections_.resize(hair.groom.section_count());
    radii_.resize(hair.groom.section_count() * k_);
    for (std::size_t w = 0; w < hair.groom.wisp_count(); ++w) {
        const std::uint32_t first = hair.groom.first_section[w], sections = hair.groom.sections(w);
        for (std::uint32_t i = 1; i + 1 < sections; ++i)
            segments_.push_back(first + i);
    }
    points_.resize(hair.groom.section_count() * (k_ + 1));
    points_boxes_.resize(hair.groom.section_count());
    boxes_.resize(segments_.size());
    directions_.resize(segments_.size());
    slenderness_.resize(segments_.size());
    for (std::size_t s = 0; s < sections_.size(); ++s)
        sections_[s].rest_area = area_of({hair.groom.radius.data() + s * k_, k_});
}

void ContactGeometry::update(const HairView& hair) {
    if (sections_.empty())
        find_segments(hair);
    for (std::uint32_t s = 0; s < sections_.size(); ++s)
        update_section(hair, s);
    for (std::size_t i = 0; i < segments_.size(); ++i)
        update_segment(i);
}

void ContactGeometry::update_section(const HairView& hair, std::uint32_t section) {
    const Slot slot = hair.layout.slot(section);
    ContactSection& c = sections_[section];
    c.x = hair.state.position.vec(slot);
    c.u = hair.frames.u.vec(slot);
    c.v = hair.frames.v.vec(slot);
    c.normal = hair.frames.normal.vec(slot);
    Vec3* points = points_.data() + section * (k_ + 1);
    points[0] = c.x;
    points_boxes_[section] = {c.x, c.x};
    for (std::uint32_t k = 0; k < k_; ++k) {
        const float r = radii_[section * k_ + k] = hair.state.radius.at(slot, k);
        points[k + 1] = c.x + (c.u * half_lines_[k].cosine + c.v * half_lines_[k].sine) * r;
        points_boxes_[section].add(points[k + 1]);
    }
    c.area = area_of(radii(section));
}

void ContactGeometry::update_segment(std::size_t index) {
    const std::uint32_t segment = segments_[index];
    boxes_[index] = box_of(segment);
    const Vec3 axis = sections_[segment + 1].x - sections_[segment].x;
    directions_[index] = normalized(axis);
    float radii_sum = 0;
    for (std::uint32_t end : {segment, segment + 1})
        for (float r : radii(end))
            radii_sum += r;
    slenderness_[index] =
        length(axis) * static_cast<float>(k_) / std::max(radii_sum, kSmallestRadius);
}

Box ContactGeometry::box_of(std::uint32_t segment) const {
    Box box;
    for (std::uint32_t end : {segment, segment + 1}) {
        const std::span<const float> r = radii(end);
        const Vec3& x = sections_[end].x;
        const Vec3 extent =
            disc_extent(sections_[end].normal, *std::max_element(r.begin(), r.end())) +
            Vec3{kBoxMargin, kBoxMargin, kBoxMargin};
        if (end == segment)
            box = {x, x};
        box.add(x - extent);
        box.add(x + extent);
    }
    return box;
}

std::optional<PlaceInSegment> ContactGeometry::place(std::size_t segment_index,
                                                     const Vec3& p) const {
    if (!boxes_[segment_index].contains(p))
        return std::nullopt;
    const std::uint32_t j = segments_[segment_index];
    const ContactSection &a = sections_[j], &b = sections_[j + 1];
    const float h0 = dot(p - a.x, a.normal), h1 = dot(b.x - p, b.normal);
    // Where the planes cross inside the wisp, both distances are negative between them.
    if (h0 * h1 < 0 || h0 + h1 == 0)
        return std::nullopt;
    const float s = h0 / (h0 + h1);

    const Vec3 off = p - (a.x + (b.x - a.x) * s);
    const Vec3 u = a.u + (b.u - a.u) * s, v = a.v + (b.v - a.v) * s;
    // The interpolated axes are not quite orthonormal: solve the 2×2 system.
    const float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), pu = dot(off, u), pv = dot(off, v);
    const float det = uu * vv - uv * uv;
    if (!(det > 1e-6f))
        return std::nullopt; // the section turned over: no inside there
    std::array<float, kMaxEnvelopePoints> r{};
    for (std::uint32_t k = 0; k < k_; ++k) {
        const float r0 = radii_[j * k_ + k], r1 = radii_[(j + 1) * k_ + k];
        r[k] = r0 + (r1 - r0) * s;
    }
    const float d2 = squared_depth(half_lines_, {r.data(), k_}, (pu * vv - pv * uv) / det,
                                   (pv * uu - pu * uv) / det);
    return PlaceInSegment{s, std::sqrt(d2)};
}

float ContactGeometry::radius_toward(std::uint32_t section, float a, float b) const {
    const float d2 = squared_depth(half_lines_, radii(section), a, b);
    return d2 > 0 ? std::sqrt((a * a + b * b) / d2) : 0.f;
}

float ContactGeometry::density(std::uint32_t segment, float s) const {
    const ContactSection &a = sections_[segment], &b = sections_[segment + 1];
    const float rest = a.rest_area + (b.rest_area - a.rest_area) * s,
                now = a.area + (b.area - a.area) * s;
    // A section squeezed flat is not infinitely dense: strands fill at most a few times their share
    // of space.
    return std::min(rest / std::max(now, 1e-12f), 10.f);
}

} // namespace mane
