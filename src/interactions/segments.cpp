#include "interactions/segments.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

// [m] rounding must not leave a section's own envelope point outside its segment's box, or the tree
// could miss it
constexpr float kBoxMargin = 1e-5f;
constexpr float kFarAway = 1e30f; // [m] where no box is

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

/// The square of the depth of section coordinates (a, b) in a section with these radii:
/// quarter-ellipses between neighbouring half lines, or their like for other K (M14a).
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

} // namespace

void ContactGeometry::lay_out(const HairView& hair) {
    k_ = hair.groom.envelope_points;
    half_lines_.assign(hair.half_lines.begin(), hair.half_lines.end());
    const auto sections = static_cast<std::uint32_t>(hair.groom.section_count());
    sections_.resize(sections);
    radii_.resize(sections * k_);
    index_of_.resize(sections);
    inside_head_.assign(sections, 0);
    for (std::size_t w = 0; w < hair.groom.wisp_count(); ++w) {
        const std::uint32_t first = hair.groom.first_section[w],
                            end = hair.groom.first_section[w + 1];
        for (std::uint32_t s = first + 1; s + 1 < end; ++s) {
            index_of_[s] = static_cast<std::uint32_t>(segments_.size());
            segments_.push_back(s);
        }
        inside_head_[first] = 1;
    }
    volumes_.resize(segments_.size());
    boxes_.resize(segments_.size());
    directions_.resize(segments_.size());
    slenderness_.resize(segments_.size());
    for (AlignedVector<float>* axis : {&x_, &y_, &z_})
        axis->assign(std::size_t{sections} * (k_ + 1) + kLanes, kFarAway);
    const Vec3 far{kFarAway, kFarAway, kFarAway};
    point_boxes_.assign(sections, {far, far});
    for (std::size_t s = 0; s < sections; ++s)
        sections_[s].rest_area = area_of({hair.groom.radius.data() + s * k_, k_});
}

void ContactGeometry::update(const HairView& hair) {
    if (sections_.empty())
        lay_out(hair);
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
    for (std::uint32_t k = 0; k < k_; ++k)
        radii_[section * k_ + k] = hair.state.radius.at(slot, k);
    c.area = area_of(radii(section));
    if (!inside_head_[section])
        update_points(section);
}

void ContactGeometry::update_segment(std::size_t index) {
    const std::uint32_t segment = segments_[index];
    boxes_[index] = box_of(segment);
    SegmentVolume& volume = volumes_[index];
    volume.box = boxes_[index];
    float radii_sum = 0;
    for (std::uint32_t e : {0u, 1u}) {
        const ContactSection& c = sections_[segment + e];
        VolumeEnd& end = volume.end[e];
        end.x = c.x, end.normal = c.normal, end.u = c.u, end.v = c.v;
        end.area = c.area, end.rest_area = c.rest_area;
        for (std::uint32_t k = 0; k < k_; ++k)
            radii_sum += end.radius[k] = radii(segment + e)[k];
    }
    const Vec3 axis = volume.end[1].x - volume.end[0].x;
    directions_[index] = normalized(axis);
    slenderness_[index] =
        length(axis) * static_cast<float>(k_) / std::max(radii_sum, kSmallestRadius);
}

void ContactGeometry::update_points(std::uint32_t section) {
    const ContactSection& c = sections_[section];
    std::size_t at = std::size_t{section} * (k_ + 1);
    Box& box = point_boxes_[section] = {c.x, c.x};
    const auto put = [&](const Vec3& p) {
        x_[at] = p.x, y_[at] = p.y, z_[at] = p.z;
        ++at;
        box.add(p);
    };
    put(c.x);
    for (std::uint32_t k = 0; k < k_; ++k)
        put(c.x + (c.u * half_lines_[k].cosine + c.v * half_lines_[k].sine) * radii(section)[k]);
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
