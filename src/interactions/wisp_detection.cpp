#include "interactions/wisp_detection.h"

#include "base/functions.h"
#include "interactions/impulse.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr std::size_t kSegmentsPerChunk = 128;
constexpr std::size_t kContactsPerChunk = 1024;

float sine_of(double degrees) {
    return static_cast<float>(sine_of_degrees(degrees));
}
float tangent_of(double degrees) {
    return static_cast<float>(sine_of_degrees(degrees) / cosine(degrees * (kPi / 180)));
}

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

/// A contact begins with nothing at the surface and counts in full where it is deeper than this:
/// with full strength at once it takes its part of the shared masses from the others in one step,
/// and a wisp that rests at another's surface beats.
constexpr float kFullDepth = 0.8f;
float weight_at(float depth) {
    return std::clamp((1 - depth) / (1 - kFullDepth), 1e-3f, 1.f);
}

Vec3 segment_direction(const HairView& hair, std::uint32_t segment) {
    return normalized(hair.state.position.vec(hair.layout.slot(segment + 1)) -
                      hair.state.position.vec(hair.layout.slot(segment)));
}

Vec3 segment_velocity(const HairView& hair, std::uint32_t segment, float s) {
    return hair.state.velocity.vec(hair.layout.slot(segment)) * (1 - s) +
           hair.state.velocity.vec(hair.layout.slot(segment + 1)) * s;
}

Vec3 point_velocity(const HairView& hair, const WispContact& contact) {
    if (contact.point.is_axis())
        return segment_velocity(hair, contact.section, contact.along);
    const Slot slot = hair.layout.slot(contact.section);
    const Vec3 velocity = hair.state.velocity.vec(slot);
    if (!contact.point.is_envelope())
        return velocity;
    const std::uint32_t k = contact.point.k();
    return velocity + half_line_direction(hair, slot, k) * hair.state.radius_rate.at(slot, k);
}

} // namespace

ContactSide point_side(const HairView& hair, const WispContact& contact) {
    return {contact.point.is_axis() ? segment_direction(hair, contact.section)
                                    : hair.frames.normal.vec(hair.layout.slot(contact.section)),
            point_velocity(hair, contact)};
}

ContactSide segment_side(const HairView& hair, const WispContact& contact) {
    return {segment_direction(hair, contact.segment),
            segment_velocity(hair, contact.segment, contact.s)};
}

WispDetection::WispDetection(const WispContactDesc& desc, const Ablation& ablation,
                             const std::string& instruction_set)
    : desc_(desc), ablation_(ablation), sine_parallel_(sine_of(desc.parallel_angle)),
      sine_parallel_leaving_(sine_of(std::min(89.f, desc.parallel_angle * desc.hysteresis))),
      tangent_(tangent_of(desc.parallel_angle)), tangent_leaving_(tangent_ * desc.hysteresis),
      sine_fade_(sine_of(desc.fade_angle)), point_test_(point_test_for(instruction_set)) {}

void WispDetection::detect(const HairView& hair, Threads& threads) {
    geometry_.update(hair);
    if (section_tree_.size() == 0)
        arrange(hair);
    section_tree_.update(geometry_.point_boxes());
    find_slender();
    const std::size_t segments = geometry_.segments().size();
    chunks_.resize((segments + kSegmentsPerChunk - 1) / kSegmentsPerChunk);
    threads.run(chunks_.size(), [&](std::size_t c) {
        chunks_[c].contacts.clear();
        chunks_[c].pairs.clear();
        const std::size_t first = c * kSegmentsPerChunk,
                          last = std::min(segments, first + kSegmentsPerChunk);
        for (std::size_t i = first; i < last; ++i)
            test_points(hair, i, chunks_[c]);
        for (std::size_t i = first; any_slender_ && i < last; ++i)
            test_axes(hair, i, chunks_[c]);
    });
    std::swap(contacts_, earlier_);
    sort_contacts(hair);
    classify_all(hair, threads);
    count_pairs();
}

/// The points of other wisps in a segment, and of its own those whose section belongs to a segment
/// that shares no section with it (M21, M22).
void WispDetection::test_points(const HairView& hair, std::size_t segment_index,
                                Found& found) const {
    const std::uint32_t segment = geometry_.segments()[segment_index];
    const std::span<const std::uint32_t> candidates =
        overlapping(section_tree_, geometry_.boxes()[segment_index], found);
    const SectionPoints points = geometry_.points();
    if (found.inside.size() < candidates.size() * points.per_section)
        found.inside.resize(candidates.size() * points.per_section);
    const std::size_t count = point_test_.find(geometry_.volume(segment_index), hair.half_lines,
                                               points, candidates, found.inside.data());

    std::uint32_t paired = ~0u; // points of a section follow each other
    for (std::size_t i = 0; i < count; ++i) {
        const PointInside& point = found.inside[i];
        const std::uint32_t section = point.point / points.per_section;
        const Belongs belongs = belongs_to(hair, section, segment);
        if (!belongs.before && !belongs.after)
            continue;
        found.contacts.push_back(
            {.section = section,
             .point = {static_cast<std::uint8_t>(point.point % points.per_section)},
             .segment = segment,
             .s = point.s,
             .density = point.density,
             .weight = weight_at(point.depth)});
        if (section != paired) {
            if (belongs.before)
                found.pairs.push_back(Pair::of(section - 1, segment));
            if (belongs.after)
                found.pairs.push_back(Pair::of(section, segment));
        }
        paired = section;
    }
}

/// A section stands for the segment before it and the one after it: which of them may touch
/// `segment`.
WispDetection::Belongs WispDetection::belongs_to(const HairView& hair, std::uint32_t section,
                                                 std::uint32_t segment) const {
    const std::uint32_t wisp = hair.layout.wisp_of(section);
    const bool begins = section + 1 < hair.groom.first_section[wisp + 1],
               ends = hair.layout.simulated(section);
    if (hair.layout.wisp_of(segment) != wisp)
        return {ends, begins};
    if (!ablation_.self_collision)
        return {false, false};
    // Two segments of one wisp must share no section.
    return {ends && (segment + 2 < section || segment > section),
            begins && (segment + 1 < section || segment > section + 1)};
}

std::span<const std::uint32_t> WispDetection::overlapping(const BoxTree& tree, const Box& box,
                                                          Found& found) const {
    std::vector<std::uint32_t>& items = found.candidates;
    std::size_t count = point_test_.overlapping(tree, box, items.data(), items.size());
    if (count > items.size()) {
        items.resize(2 * count);
        count = point_test_.overlapping(tree, box, items.data(), items.size());
    }
    return {items.data(), count};
}

/// Trees from the design: the hair that lies together there.
void WispDetection::arrange(const HairView& hair) {
    section_tree_.arrange(hair.groom.position);
    std::vector<Vec3> centres;
    for (const std::uint32_t segment : geometry_.segments())
        centres.push_back((hair.groom.position[segment] + hair.groom.position[segment + 1]) / 2.f);
    segment_tree_.arrange(centres);
}

void WispDetection::find_slender() {
    any_slender_ = false;
    for (std::size_t i = 0; i < geometry_.segments().size() && !any_slender_; ++i)
        any_slender_ = slender(i);
    if (any_slender_)
        segment_tree_.update(geometry_.boxes());
}

bool WispDetection::slender(std::size_t segment_index) const {
    return geometry_.slenderness(segment_index) > desc_.axis_contact_ratio;
}

/// Ours, beyond the paper's footnote: thin segments can cross without a point of one inside the
/// other. Finds each pair of which one is slender once, from its slender side, or from the first of
/// two.
void WispDetection::test_axes(const HairView& hair, std::size_t a_index, Found& found) const {
    if (!slender(a_index))
        return;
    const std::uint32_t a = geometry_.segments()[a_index];
    const Vec3 &a0 = geometry_.section(a).x, &a1 = geometry_.section(a + 1).x;
    const auto reach = [&](std::uint32_t segment, float s, const Vec3& toward) {
        const auto of = [&](std::uint32_t section) {
            const ContactSection& x = geometry_.section(section);
            return geometry_.radius_toward(section, dot(toward, x.u), dot(toward, x.v));
        };
        return of(segment) * (1 - s) + of(segment + 1) * s;
    };
    for (const std::uint32_t b_index :
         overlapping(segment_tree_, geometry_.boxes()[a_index], found)) {
        const std::uint32_t b = geometry_.segments()[b_index];
        if (a == b || (b < a && slender(b_index)))
            continue;
        const bool same_wisp = hair.layout.wisp_of(a) == hair.layout.wisp_of(b);
        if (same_wisp && (!ablation_.self_collision || std::max(a, b) - std::min(a, b) < 2))
            continue;
        const Vec3 &b0 = geometry_.section(b).x, &b1 = geometry_.section(b + 1).x;
        // Nearly parallel axes have no one closest place; their points find each other.
        const Vec3 n = cross(geometry_.direction(a_index), geometry_.direction(b_index));
        if (dot(n, n) < sine_fade_ * sine_fade_)
            continue;
        const ClosestPoints c = closest_points(a0, a1, b0, b1);
        if (!c.inside)
            continue;
        const Vec3 gap = (b0 + (b1 - b0) * c.t) - (a0 + (a1 - a0) * c.s);
        const float touching = reach(a, c.s, gap) + reach(b, c.t, -gap);
        if (length(gap) > touching)
            continue;
        // Told from the earlier segment, whichever was slender.
        const bool swap = b < a;
        found.contacts.push_back({.section = swap ? b : a,
                                  .point = {ContactPoint::kAxis},
                                  .segment = swap ? a : b,
                                  .s = swap ? c.s : c.t,
                                  .along = swap ? c.t : c.s,
                                  .density = geometry_.density(swap ? a : b, swap ? c.s : c.t),
                                  .weight = weight_at(length(gap) / touching)});
    }
}

/// By section, then point, then segment: chunks have them by segment already.
void WispDetection::sort_contacts(const HairView& hair) {
    const std::uint32_t codes = hair.groom.envelope_points + 2; // skeleton, envelope, axis
    const auto place = [codes](const WispContact& c) {
        return c.section * codes + (c.point.is_axis() ? codes - 1 : c.point.code);
    };
    places_.start(std::size_t{hair.groom.section_count()} * codes);
    for (const Found& found : chunks_)
        for (const WispContact& c : found.contacts)
            places_.count(place(c));
    contacts_.resize(places_.add_up());
    for (const Found& found : chunks_)
        for (const WispContact& c : found.contacts)
            contacts_[places_.next(place(c))] = c;
    places_.finish();
    if (!any_slender_)
        return;
    // An axis contact is told from the earlier of two segments, whichever found it.
    for (std::size_t at = codes - 1; at < places_.size(); at += codes)
        std::sort(contacts_.begin() + places_.first(at), contacts_.begin() + places_.last(at),
                  before);
}

/// Each pair once: those with the same lower segment side by side, then marked as they are met.
void WispDetection::count_pairs() {
    const std::size_t sections = geometry_.section_count();
    lower_.start(sections);
    for (const Found& found : chunks_)
        for (const Pair& p : found.pairs)
            lower_.count(p.lower);
    higher_.resize(lower_.add_up());
    for (const Found& found : chunks_)
        for (const Pair& p : found.pairs)
            higher_[lower_.next(p.lower)] = p.higher;
    lower_.finish();
    met_.assign(sections, ~0u);
    intersecting_pairs_ = 0;
    for (std::uint32_t lower = 0; lower < sections; ++lower)
        for (std::uint32_t i = lower_.first(lower); i < lower_.last(lower); ++i) {
            intersecting_pairs_ += met_[higher_[i]] != lower;
            met_[higher_[i]] = lower;
        }
}

void WispDetection::classify(const HairView& hair, WispContact& contact,
                             const WispContact* earlier) const {
    if (desc_.mode == WispContactMode::isotropic) {
        contact.kind = WispContactKind::collision;
        return;
    }
    const bool was_friction = earlier && earlier->kind == WispContactKind::friction;
    contact.kind = WispContactKind::collision;
    const Vec3& point_direction =
        contact.point.is_axis() ? geometry_.direction(geometry_.segment_index(contact.section))
                                : geometry_.section(contact.section).normal;
    const Vec3 n =
        cross(point_direction, geometry_.direction(geometry_.segment_index(contact.segment)));
    const float sine = length(n);
    if (sine >= (was_friction ? sine_parallel_leaving_ : sine_parallel_))
        return;
    if (sine >= sine_fade_) {
        const Vec3 unit = n / sine, v = point_velocity(hair, contact) -
                                        segment_velocity(hair, contact.segment, contact.s);
        const float out = std::fabs(dot(v, unit));
        const float in = length(v - unit * dot(v, unit));
        const float slow = desc_.sliding_speed * (was_friction ? desc_.hysteresis : 1.f);
        if (out > std::max((was_friction ? tangent_leaving_ : tangent_) * in, slow))
            return;
    }
    contact.kind = WispContactKind::friction;
}

void WispDetection::classify_all(const HairView& hair, Threads& threads) {
    threads.run((contacts_.size() + kContactsPerChunk - 1) / kContactsPerChunk, [&](std::size_t c) {
        const std::size_t first = c * kContactsPerChunk,
                          last = std::min(contacts_.size(), first + kContactsPerChunk);
        auto earlier = std::lower_bound(earlier_.begin(), earlier_.end(), contacts_[first], before);
        for (std::size_t i = first; i < last; ++i) {
            while (earlier != earlier_.end() && before(*earlier, contacts_[i]))
                ++earlier;
            const bool found = earlier != earlier_.end() && same_place(*earlier, contacts_[i]);
            classify(hair, contacts_[i], found ? &*earlier : nullptr);
        }
    });
}

} // namespace mane
