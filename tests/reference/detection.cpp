/// §4.1: "a collision is detected when at least one of the skeleton or envelope point-masses of a
/// wisp segment penetrates inside the volume of the other one. This volume is defined by its two
/// cross sections."

#include "reference/interactions.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace mane::reference {
namespace {

constexpr double kLeastRadius = 1e-6; // [m] a section squeezed flat still has a depth everywhere
constexpr double kBoxMargin = 1e-5;   // [m]

Vec3d mix(const Vec3d& a, const Vec3d& b, double s) {
    return (1 - s) * a + s * b;
}

/// Half of the size, along one world axis, of a disc of radius r whose normal has the component c
/// there.
double disc_extent(double c, double r) {
    return r * std::sqrt(std::max(0.0, 1 - c * c));
}

/// The bounding box of a segment, along one axis: around its sections' discs.
bool within_box(double p, double x0, double n0, double r0, double x1, double n1, double r1) {
    const double e0 = disc_extent(n0, r0) + kBoxMargin, e1 = disc_extent(n1, r1) + kBoxMargin;
    return std::min(x0 - e0, x1 - e1) <= p && p <= std::max(x0 + e0, x1 + e1);
}

bool in_bounding_box(const Wisp& wisp, const std::vector<SectionFrame>& frames, std::size_t j,
                     const Vec3d& p) {
    const Vec3d &a = wisp.x[j], &b = wisp.x[j + 1], &m = frames[j].n, &n = frames[j + 1].n;
    const double r = *std::max_element(wisp.r[j].begin(), wisp.r[j].end());
    const double q = *std::max_element(wisp.r[j + 1].begin(), wisp.r[j + 1].end());
    return within_box(p.x, a.x, m.x, r, b.x, n.x, q) && within_box(p.y, a.y, m.y, r, b.y, n.y, q) &&
           within_box(p.z, a.z, m.z, r, b.z, n.z, q);
}

double area(const Ring& r) {
    double sum = 0;
    for (std::size_t k = 0; k < r.size(); ++k)
        sum += r[k] * r[(k + 1) % r.size()];
    return sum;
}

/// Strand density, relative to rest: as many strands in a smaller area. They fill space at ten
/// times their rest density.
double density(const Wisp& wisp, std::size_t j, double s) {
    const double rest = (1 - s) * area(wisp.design_radius[j]) + s * area(wisp.design_radius[j + 1]);
    const double now = (1 - s) * area(wisp.r[j]) + s * area(wisp.r[j + 1]);
    return std::min(rest / std::max(now, 1e-12), 10.0);
}

/// Ours: a contact counts for nothing at the surface and in full from a fifth of the depth on.
double weight_at(double depth) {
    return std::clamp((1 - depth) / 0.2, 1e-3, 1.0);
}

/// Every simulated segment of the hair, by its first section.
std::vector<Site> simulated_segments(const Hair& hair) {
    std::vector<Site> segments;
    for (std::size_t w = 0; w < hair.wisps.size(); ++w)
        for (std::size_t i = 1; i + 1 < hair.wisps[w].sections(); ++i)
            segments.push_back({w, i});
    return segments;
}

/// M22: segments that share a section touch always.
bool share_section(const Site& a, const Site& b) {
    return a.wisp == b.wisp && a.section <= b.section + 1 && b.section <= a.section + 1;
}

/// Whether some simulated segment that the section belongs to may touch the segment.
bool may_touch(const Wisp& wisp, const Site& section, const Site& segment) {
    const Site before = {section.wisp, section.section - 1};
    const bool ends_one = section.section >= 2, begins_one = section.section + 1 < wisp.sections();
    return (ends_one && !share_section(before, segment)) ||
           (begins_one && !share_section(section, segment));
}

/// What a search needs at hand.
struct Search {
    const Hair& hair;
    const WispContactDesc& desc;
    Frames frames;
    std::vector<Site> segments;

    const Wisp& wisp(const Site& site) const { return hair.wisps[site.wisp]; }

    Vec3d point(const Site& section, int k) const {
        const Wisp& w = wisp(section);
        const std::size_t i = section.section;
        if (k == Contact::kSkeleton)
            return w.x[i];
        const std::size_t ray = static_cast<std::size_t>(k);
        return w.x[i] + w.r[i][ray] * half_line(frames[section.wisp][i], ray, w.points());
    }

    /// The place of a section's point in the segment, if it is inside.
    std::optional<PlaceInSegment> inside(const Site& section, int k, const Site& segment) const {
        const auto place = place_in_segment(wisp(segment), frames[segment.wisp], segment.section,
                                            point(section, k));
        return place && place->depth <= 1 ? place : std::nullopt;
    }

    std::size_t intersecting_pairs() const;
    void find_points(const Site& section, std::vector<Contact>& found) const;
    void find_axes(const Site& a, std::vector<Contact>& found) const;
    std::optional<Contact> axes_touch(const Site& a, const Site& b) const;
    double reach(const Site& segment, double s, const Vec3d& toward) const;
    bool slender(const Site& segment) const;
};

bool any_point_inside(const Search& search, const Site& a, const Site& b) {
    const int points = static_cast<int>(search.wisp(a).points());
    for (const Site& section : {a, Site{a.wisp, a.section + 1}})
        for (int k = Contact::kSkeleton; k < points; ++k)
            if (search.inside(section, k, b))
                return true;
    return false;
}

std::size_t Search::intersecting_pairs() const {
    std::size_t count = 0;
    for (const Site& a : segments)
        for (const Site& b : segments)
            if (a < b && !share_section(a, b))
                count += any_point_inside(*this, a, b) || any_point_inside(*this, b, a);
    return count;
}

void Search::find_points(const Site& section, std::vector<Contact>& found) const {
    for (int k = Contact::kSkeleton; k < static_cast<int>(wisp(section).points()); ++k)
        for (const Site& segment : segments) {
            if (!may_touch(wisp(section), section, segment))
                continue;
            const auto place = inside(section, k, segment);
            if (!place)
                continue;
            Contact contact;
            contact.point = section;
            contact.k = k;
            contact.segment = segment;
            contact.s = place->s;
            contact.density = density(wisp(segment), segment.section, place->s);
            contact.weight = weight_at(place->depth);
            found.push_back(contact);
        }
}

bool Search::slender(const Site& segment) const {
    const Wisp& w = wisp(segment);
    double sum = 0;
    for (const std::size_t end : {segment.section, segment.section + 1})
        sum += std::accumulate(w.r[end].begin(), w.r[end].end(), 0.0);
    const double mean_diameter = sum / static_cast<double>(w.points());
    return length(w.x[segment.section + 1] - w.x[segment.section]) >
           static_cast<double>(desc.axis_contact_ratio) * mean_diameter;
}

/// The radius at s of the segment in a direction.
double Search::reach(const Site& segment, double s, const Vec3d& toward) const {
    const auto at = [&](std::size_t i) {
        const SectionFrame& frame = frames[segment.wisp][i];
        const double a = dot(toward, frame.u), b = dot(toward, frame.v);
        const double depth = depth_in_section(wisp(segment).r[i], a, b);
        return depth > 0 ? std::hypot(a, b) / depth : 0.0;
    };
    return (1 - s) * at(segment.section) + s * at(segment.section + 1);
}

/// Ours: the closest points of two axes, where both lie inside their segments.
std::optional<Contact> Search::axes_touch(const Site& a, const Site& b) const {
    if (share_section(a, b) || (!slender(a) && !slender(b)))
        return std::nullopt;
    const Vec3d &p = wisp(a).x[a.section], d = wisp(a).x[a.section + 1] - p;
    const Vec3d &q = wisp(b).x[b.section], e = wisp(b).x[b.section + 1] - q;
    // Nearly parallel axes have no one closest place; their points find each other.
    const double fade = std::sin(static_cast<double>(desc.fade_angle) * std::numbers::pi / 180);
    const Vec3d across = cross(d, e);
    if (length(cross(normalized(d), normalized(e))) < fade || length(across) == 0)
        return std::nullopt;
    const double on_a = dot(cross(q - p, e), across) / dot(across, across);
    const double on_b = dot(cross(q - p, d), across) / dot(across, across);
    if (!(on_a > 0 && on_a < 1 && on_b > 0 && on_b < 1))
        return std::nullopt;

    const Vec3d gap = (q + on_b * e) - (p + on_a * d);
    const double touching = reach(a, on_a, gap) + reach(b, on_b, -gap), distance = length(gap);
    if (distance > touching)
        return std::nullopt;
    Contact contact;
    contact.point = a;
    contact.k = Contact::kAxis;
    contact.along = on_a;
    contact.segment = b;
    contact.s = on_b;
    contact.density = density(wisp(b), b.section, on_b);
    contact.weight = weight_at(touching > 0 ? distance / touching : 0);
    return contact;
}

void Search::find_axes(const Site& a, std::vector<Contact>& found) const {
    for (const Site& b : segments)
        if (a < b)
            if (const auto contact = axes_touch(a, b))
                found.push_back(*contact);
}

bool was_friction(const Contact& contact, const std::vector<Contact>& earlier) {
    return std::any_of(earlier.begin(), earlier.end(), [&](const Contact& e) {
        return e.friction && e.point == contact.point && e.k == contact.k &&
               e.segment == contact.segment;
    });
}

} // namespace

double depth_in_section(const Ring& radii, double a, double b) {
    const double sector = 2 * std::numbers::pi / static_cast<double>(radii.size());
    const double angle = std::atan2(b, a);
    const double turned = angle < 0 ? angle + 2 * std::numbers::pi : angle;
    const std::size_t k = static_cast<std::size_t>(turned / sector) % radii.size();

    // The point in the sector's own oblique coordinates, each over the radius of its half line.
    const double from = turned - static_cast<double>(k) * sector, size = std::hypot(a, b);
    const double alpha =
        size * std::sin(sector - from) / std::sin(sector) / std::max(radii[k], kLeastRadius);
    const double beta = size * std::sin(from) / std::sin(sector) /
                        std::max(radii[(k + 1) % radii.size()], kLeastRadius);
    return std::sqrt(
        std::max(alpha * alpha + beta * beta + 2 * alpha * beta * std::cos(sector), 0.0));
}

std::optional<PlaceInSegment> place_in_segment(const Wisp& wisp,
                                               const std::vector<SectionFrame>& frames,
                                               std::size_t j, const Vec3d& p) {
    if (!in_bounding_box(wisp, frames, j, p))
        return std::nullopt;
    const double h0 = dot(p - wisp.x[j], frames[j].n), h1 = dot(wisp.x[j + 1] - p, frames[j + 1].n);
    // Where the two planes cross inside the wisp, both distances are negative between them.
    if (h0 * h1 < 0 || h0 + h1 == 0)
        return std::nullopt;
    const double s = h0 / (h0 + h1);

    const Vec3d u = mix(frames[j].u, frames[j + 1].u, s), v = mix(frames[j].v, frames[j + 1].v, s);
    const Vec3d off = p - mix(wisp.x[j], wisp.x[j + 1], s);
    // The mixed axes are oblique: off = a u + b v + (something across both).
    const Vec3d n = cross(u, v);
    if (dot(n, n) <= 1e-6)
        return std::nullopt; // the section turned over: it has no inside there
    const double a = dot(cross(off, v), n) / dot(n, n), b = dot(cross(u, off), n) / dot(n, n);
    Ring r(wisp.points());
    for (std::size_t k = 0; k < r.size(); ++k)
        r[k] = (1 - s) * wisp.r[j][k] + s * wisp.r[j + 1][k];
    return PlaceInSegment{s, depth_in_section(r, a, b)};
}

Detection detect(const Hair& hair, const WispContactDesc& desc,
                 const std::vector<Contact>& earlier) {
    const Search search = {hair, desc, all_frames(hair), simulated_segments(hair)};
    Detection result;
    for (std::size_t w = 0; w < hair.wisps.size(); ++w)
        for (std::size_t i = 1; i < hair.wisps[w].sections(); ++i) {
            search.find_points({w, i}, result.contacts);
            if (i + 1 < hair.wisps[w].sections())
                search.find_axes({w, i}, result.contacts);
        }
    for (Contact& contact : result.contacts)
        contact.friction =
            desc.mode == WispContactMode::anisotropic &&
            quasi_parallel(point_side(hair, search.frames, contact), segment_side(hair, contact),
                           desc, was_friction(contact, earlier));
    result.intersecting_pairs = search.intersecting_pairs();
    return result;
}

} // namespace mane::reference
