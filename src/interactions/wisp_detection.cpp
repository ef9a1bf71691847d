#include "interactions/wisp_detection.h"

#include "base/functions.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr std::size_t kPairsPerChunk = 512;
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

WispDetection::WispDetection(const WispContactDesc& desc)
    : desc_(desc), sine_parallel_(sine_of_degrees(desc.parallel_angle)),
      sine_parallel_leaving_(
          sine_of_degrees(std::min(89.f, desc.parallel_angle * desc.hysteresis))),
      tangent_(tangent_of_degrees(desc.parallel_angle)),
      tangent_leaving_(tangent_ * desc.hysteresis), sine_fade_(sine_of_degrees(desc.fade_angle)) {}

void WispDetection::detect(const HairView& hair, Threads& threads) {
    geometry_.update(hair);
    const std::vector<SegmentPair>& pairs = grid_.overlapping_pairs(geometry_, threads);
    chunks_.resize((pairs.size() + kPairsPerChunk - 1) / kPairsPerChunk);
    threads.run(chunks_.size(), [&](std::size_t c) {
        chunks_[c].contacts.clear();
        chunks_[c].intersecting_pairs = 0;
        const std::size_t last = std::min(pairs.size(), (c + 1) * kPairsPerChunk);
        for (std::size_t i = c * kPairsPerChunk; i < last; ++i)
            test_pair(hair, pairs[i], chunks_[c]);
    });

    std::swap(contacts_, earlier_);
    contacts_.clear();
    intersecting_pairs_ = 0;
    for (const Found& found : chunks_) {
        contacts_.insert(contacts_.end(), found.contacts.begin(), found.contacts.end());
        intersecting_pairs_ += found.intersecting_pairs;
    }
    std::stable_sort(contacts_.begin(), contacts_.end(), before);
    classify_all(hair, threads);
}

void WispDetection::test_pair(const HairView& hair, const SegmentPair& pair, Found& found) const {
    const std::uint32_t a = geometry_.segments()[pair.a], b = geometry_.segments()[pair.b];
    const bool same_wisp = hair.layout.wisp_of(a) == hair.layout.wisp_of(b);
    if (same_wisp && b - a < 2)
        return; // M22: they share a section
    const bool a_in_b = test_points(hair, a, pair.b, found);
    const bool b_in_a = test_points(hair, b, pair.a, found);
    found.intersecting_pairs += a_in_b || b_in_a;
    test_axes(pair.a, pair.b, found);
}

/// The points of both sections of segment `a` in segment `b`. A section between two segments is
/// tested with both, but becomes a contact only with the one that begins there, unless that one may
/// not touch `b`.
bool WispDetection::test_points(const HairView& hair, std::uint32_t a, std::size_t b_index,
                                Found& found) const {
    const std::uint32_t b = geometry_.segments()[b_index];
    const std::uint32_t wisp = hair.layout.wisp_of(a);
    const bool same_wisp = wisp == hair.layout.wisp_of(b);
    bool any = false;
    for (std::uint32_t section : {a, a + 1}) {
        bool mine = section == a;
        if (!mine) {
            const bool is_tip = section + 1 == hair.groom.first_section[wisp + 1];
            const bool next_touches_b = same_wisp && section + 1 >= b && section <= b + 1;
            mine = is_tip || next_touches_b;
        }
        const auto test = [&](ContactPoint point, const Vec3& p) {
            const std::optional<PlaceInSegment> place = geometry_.place(b_index, p);
            if (!place || place->depth > 1)
                return;
            any = true;
            if (!mine)
                return;
            WispContact contact;
            contact.section = section;
            contact.point = point;
            contact.segment = b;
            contact.s = place->s;
            contact.density = geometry_.density(b, place->s);
            found.contacts.push_back(contact);
        };
        test({ContactPoint::kSkeleton}, geometry_.section(section).x);
        for (std::uint32_t k = 0; k < geometry_.envelope_points(); ++k)
            test(ContactPoint::envelope(k), geometry_.envelope_point(section, k));
    }
    return any;
}

/// Ours, beyond the paper's footnote: thin segments can cross without a point of one inside the
/// other.
void WispDetection::test_axes(std::size_t a_index, std::size_t b_index, Found& found) const {
    const std::uint32_t a = geometry_.segments()[a_index], b = geometry_.segments()[b_index];
    const Vec3 &a0 = geometry_.section(a).x, &a1 = geometry_.section(a + 1).x;
    const Vec3 &b0 = geometry_.section(b).x, &b1 = geometry_.section(b + 1).x;
    const auto slender = [&](std::uint32_t segment, const Vec3& along) {
        float sum = 0;
        for (std::uint32_t end : {segment, segment + 1})
            for (float r : geometry_.radii(end))
                sum += r;
        const float mean_diameter = sum / static_cast<float>(geometry_.envelope_points());
        return length(along) > desc_.axis_contact_ratio * mean_diameter;
    };
    if (!slender(a, a1 - a0) && !slender(b, b1 - b0))
        return;

    // Nearly parallel axes have no one closest place; their points find each other.
    const Vec3 n = cross(normalized(a1 - a0), normalized(b1 - b0));
    if (dot(n, n) < sine_fade_ * sine_fade_)
        return;
    const ClosestPoints c = closest_points(a0, a1, b0, b1);
    if (!c.inside)
        return;
    const Vec3 gap = (b0 + (b1 - b0) * c.t) - (a0 + (a1 - a0) * c.s);
    const auto reach = [&](std::uint32_t segment, float s, const Vec3& toward) {
        const auto of = [&](std::uint32_t section) {
            const ContactSection& x = geometry_.section(section);
            return geometry_.radius_toward(section, dot(toward, x.u), dot(toward, x.v));
        };
        return of(segment) * (1 - s) + of(segment + 1) * s;
    };
    const float distance = length(gap);
    if (distance > reach(a, c.s, gap) + reach(b, c.t, -gap))
        return;
    WispContact contact;
    contact.section = a;
    contact.point = {ContactPoint::kAxis};
    contact.along = c.s;
    contact.segment = b;
    contact.s = c.t;
    contact.density = geometry_.density(b, c.t);
    found.contacts.push_back(contact);
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
