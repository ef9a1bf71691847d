#include "interactions/wisp_detection.h"

#include "base/functions.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr std::size_t kSectionsPerChunk = 128;
constexpr std::size_t kContactsPerChunk = 1024;

float sine_of_degrees(double degrees) {
    return static_cast<float>(sine(degrees * (kPi / 180)));
}
float tangent_of_degrees(double degrees) {
    return static_cast<float>(sine(degrees * (kPi / 180)) / cosine(degrees * (kPi / 180)));
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

} // namespace

ContactSide point_side(const HairView& hair, const WispContact& contact) {
    if (contact.point.is_axis())
        return {segment_direction(hair, contact.section),
                segment_velocity(hair, contact.section, contact.along)};
    const Slot slot = hair.layout.slot(contact.section);
    ContactSide side{hair.frames.normal.vec(slot), hair.state.velocity.vec(slot)};
    if (contact.point.is_envelope()) {
        const std::uint32_t k = contact.point.k();
        const HalfLine& d = hair.half_lines[k];
        side.velocity += (hair.frames.u.vec(slot) * d.cosine + hair.frames.v.vec(slot) * d.sine) *
                         hair.state.radius_rate.at(slot, k);
    }
    return side;
}

ContactSide segment_side(const HairView& hair, const WispContact& contact) {
    return {segment_direction(hair, contact.segment),
            segment_velocity(hair, contact.segment, contact.s)};
}

WispDetection::WispDetection(const WispContactDesc& desc, const Ablation& ablation)
    : desc_(desc), ablation_(ablation), sine_parallel_(sine_of_degrees(desc.parallel_angle)),
      sine_parallel_leaving_(
          sine_of_degrees(std::min(89.f, desc.parallel_angle * desc.hysteresis))),
      tangent_(tangent_of_degrees(desc.parallel_angle)),
      tangent_leaving_(tangent_ * desc.hysteresis), sine_fade_(sine_of_degrees(desc.fade_angle)) {}

void WispDetection::detect(const HairView& hair, Threads& threads) {
    geometry_.update(hair);
    grid_.build(geometry_);
    const std::size_t sections = geometry_.section_count(), segments = geometry_.segments().size();
    chunks_.resize((sections + kSectionsPerChunk - 1) / kSectionsPerChunk);
    threads.run(chunks_.size(), [&](std::size_t c) {
        chunks_[c].contacts.clear();
        chunks_[c].pairs.clear();
        const std::size_t first = c * kSectionsPerChunk, last = first + kSectionsPerChunk;
        for (std::size_t s = first; s < std::min(sections, last); ++s)
            test_section(hair, static_cast<std::uint32_t>(s), chunks_[c]);
        for (std::size_t a = first; a < std::min(segments, last); ++a)
            test_axes(hair, a, chunks_[c]);
    });

    std::swap(contacts_, earlier_);
    contacts_.clear();
    for (const Found& found : chunks_)
        contacts_.insert(contacts_.end(), found.contacts.begin(), found.contacts.end());
    std::stable_sort(contacts_.begin(), contacts_.end(), before);
    classify_all(hair, threads);
    count_pairs();
}

/// The points of a section in the segments of other wisps, and in those of its own that share no
/// section with a segment it belongs to (M21, M22).
void WispDetection::test_section(const HairView& hair, std::uint32_t section, Found& found) const {
    const std::uint32_t wisp = hair.layout.wisp_of(section), first = hair.groom.first_section[wisp];
    const std::uint32_t end = hair.groom.first_section[wisp + 1];
    if (section == first)
        return; // x₀ is inside the head
    const bool ends_segment = section >= first + 2, begins_segment = section + 1 < end;
    const std::span<const Vec3> points = geometry_.points(section);
    grid_.for_overlapping(geometry_, geometry_.points_box(section), [&](std::size_t index) {
        const std::uint32_t segment = geometry_.segments()[index];
        const bool same_wisp = segment >= first && segment < end;
        if (same_wisp && !ablation_.self_collision)
            return;
        // Of the segment before (section − 1) and the one after (section), those that may touch
        // this one.
        const bool before_may =
            ends_segment && !(same_wisp && segment + 2 >= section && segment <= section);
        const bool after_may =
            begins_segment && !(same_wisp && segment + 1 >= section && segment <= section + 1);
        if (!before_may && !after_may)
            return;
        bool any = false;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::optional<PlaceInSegment> place = geometry_.place(index, points[i]);
            if (!place || place->depth > 1)
                continue;
            any = true;
            found.contacts.push_back({.section = section,
                                      .point = {static_cast<std::uint8_t>(i)},
                                      .segment = segment,
                                      .s = place->s,
                                      .density = geometry_.density(segment, place->s),
                                      .weight = weight_at(place->depth)});
        }
        if (!any)
            return;
        const auto key = [segment](std::uint32_t mine) {
            return std::uint64_t{std::min(mine, segment)} << 32 | std::max(mine, segment);
        };
        if (before_may)
            found.pairs.push_back(key(section - 1));
        if (after_may)
            found.pairs.push_back(key(section));
    });
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
    grid_.for_overlapping(geometry_, geometry_.box(a_index), [&](std::size_t b_index) {
        const std::uint32_t b = geometry_.segments()[b_index];
        if (a == b || (b < a && slender(b_index)))
            return;
        const bool same_wisp = hair.layout.wisp_of(a) == hair.layout.wisp_of(b);
        if (same_wisp && (!ablation_.self_collision || std::max(a, b) - std::min(a, b) < 2))
            return;
        const Vec3 &b0 = geometry_.section(b).x, &b1 = geometry_.section(b + 1).x;
        // Nearly parallel axes have no one closest place; their points find each other.
        const Vec3 n = cross(geometry_.direction(a_index), geometry_.direction(b_index));
        if (dot(n, n) < sine_fade_ * sine_fade_)
            return;
        const ClosestPoints c = closest_points(a0, a1, b0, b1);
        if (!c.inside)
            return;
        const Vec3 gap = (b0 + (b1 - b0) * c.t) - (a0 + (a1 - a0) * c.s);
        const float touching = reach(a, c.s, gap) + reach(b, c.t, -gap);
        if (length(gap) > touching)
            return;
        // Told from the earlier segment, whichever was slender.
        const bool swap = b < a;
        found.contacts.push_back({.section = swap ? b : a,
                                  .point = {ContactPoint::kAxis},
                                  .segment = swap ? a : b,
                                  .s = swap ? c.s : c.t,
                                  .along = swap ? c.t : c.s,
                                  .density = geometry_.density(swap ? a : b, swap ? c.s : c.t),
                                  .weight = weight_at(length(gap) / touching)});
    });
}

void WispDetection::count_pairs() {
    pairs_.clear();
    for (const Found& found : chunks_)
        pairs_.insert(pairs_.end(), found.pairs.begin(), found.pairs.end());
    std::sort(pairs_.begin(),
              pairs_.end()); // only to count each once: nothing depends on the order of equals
    intersecting_pairs_ =
        static_cast<std::uint64_t>(std::unique(pairs_.begin(), pairs_.end()) - pairs_.begin());
}

void WispDetection::classify(const HairView& hair, WispContact& contact,
                             const WispContact* earlier) const {
    if (desc_.mode == WispContactMode::isotropic) {
        contact.kind = WispContactKind::collision;
        return;
    }
    const bool was_friction = earlier && earlier->kind == WispContactKind::friction;
    const ContactSide p = point_side(hair, contact), s = segment_side(hair, contact);
    const Vec3 n = cross(p.direction, s.direction);
    const float sine = length(n);
    contact.kind = WispContactKind::collision;
    if (sine >= (was_friction ? sine_parallel_leaving_ : sine_parallel_))
        return;
    if (sine >= sine_fade_) {
        const Vec3 unit = n / sine, v = p.velocity - s.velocity;
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
