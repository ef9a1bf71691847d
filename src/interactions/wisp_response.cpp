#include "interactions/wisp_response.h"

#include "base/functions.h"
#include "interactions/wisp_detection.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr std::size_t kContactsPerChunk = 512;
constexpr std::size_t kSectionsPerChunk = 256;

/// The sections of a contact with their weights: those of the point, then the two ends of the
/// segment.
struct Participants {
    struct One {
        std::uint32_t section;
        float weight;     ///< in the relative velocity
        float compliance; ///< what the weight's square stands for in W
        ContactPoint point;
    };
    One items[4];
    int count = 0;
    void add(One one) { items[count++] = one; }
};

Participants participants(const WispContact& c, const Layout& layout) {
    constexpr ContactPoint skeleton{ContactPoint::kSkeleton};
    Participants p;
    const auto add_ends = [&](std::uint32_t segment, float s, float sign) {
        p.add({segment, sign * (1 - s), (1 - s) * (1 - s), skeleton});
        // Next to an end that the head holds, a contact at small s would fling the other end at 1/s of its velocity: there the
        // weight counts once. That is a viscosity in series, so energy still falls.
        p.add({segment + 1, sign * s, layout.simulated(segment) ? s * s : s, skeleton});
    };
    if (c.point.is_axis())
        add_ends(c.section, c.along, 1);
    else
        p.add({c.section, 1, 1, c.point});
    add_ends(c.segment, c.s, -1);
    return p;
}

/// 3τ² − 2τ³, from 0 at `low` to 1 at `high`.
float smooth_step(float x, float low, float high) {
    const float t = std::clamp((x - low) / (high - low), 0.f, 1.f);
    return t * t * (3 - 2 * t);
}

} // namespace

WispResponse::WispResponse(const WispContactDesc& desc)
    : desc_(desc), sine_fade_(static_cast<float>(sine(desc.fade_angle * (kPi / 180)))) {}

void WispResponse::engage(const HairView& hair, std::span<const WispContact> contacts) {
    contacts_.assign(contacts.begin(), contacts.end());
    impulses_.resize(contacts_.size());
    build(hair, all_, true);
    build(hair, collisions_, false);
}

void WispResponse::build(const HairView& hair, Set& set, bool with_friction) const {
    const std::uint32_t k = hair.groom.envelope_points;
    set.contacts.clear();
    set.sections.clear();
    set.skeleton_count.assign(hair.groom.section_count(), 0);
    set.skeleton_weight.assign(hair.groom.section_count(), 0);
    set.envelope_weight.assign(hair.groom.section_count() * k, 0);
    for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
        const WispContact& c = contacts_[i];
        if (c.kind == WispContactKind::friction && !with_friction)
            continue;
        const Participants all = participants(c, hair.layout);
        bool any_moves = false;
        for (int j = 0; j < all.count; ++j)
            any_moves = any_moves || hair.layout.simulated(all.items[j].section);
        if (!any_moves)
            continue;
        set.contacts.push_back(i);
        for (int j = 0; j < all.count; ++j) {
            const auto& one = all.items[j];
            if (set.skeleton_count[one.section]++ == 0)
                set.sections.push_back(one.section);
            set.skeleton_weight[one.section] += c.weight;
            if (one.point.is_envelope())
                set.envelope_weight[one.section * k + one.point.k()] += c.weight;
        }
    }
    for (std::vector<float>* weights : {&set.skeleton_weight, &set.envelope_weight})
        for (float& weight : *weights)
            weight = std::max(weight, 1.f);
    std::sort(set.sections.begin(),
              set.sections.end()); // each once: the order of equals does not arise

    // Shares by section, in the order of contacts: counted, then filled.
    std::vector<std::uint32_t> entry_of(hair.groom.section_count());
    set.first_share.assign(set.sections.size() + 1, 0);
    for (std::size_t e = 0; e < set.sections.size(); ++e) {
        entry_of[set.sections[e]] = static_cast<std::uint32_t>(e);
        set.first_share[e + 1] = set.first_share[e] + set.skeleton_count[set.sections[e]];
    }
    set.shares.resize(set.first_share.back());
    std::vector<std::uint32_t> next(set.first_share.begin(), set.first_share.end() - 1);
    for (std::uint32_t i : set.contacts) {
        const Participants all = participants(contacts_[i], hair.layout);
        for (int j = 0; j < all.count; ++j)
            set.shares[next[entry_of[all.items[j].section]]++] = {i, all.items[j].weight,
                                                                  all.items[j].point};
    }
}

/// (W + Z) J = −v_rel, see docs/model.md, "Each contact is one impulse".
Vec3 WispResponse::impulse(const HairView& hair, const Set& set, const WispContact& contact,
                           float friction_time) const {
    const std::uint32_t k = hair.groom.envelope_points;
    Symmetric3 w;
    const Participants all = participants(contact, hair.layout);
    for (int j = 0; j < all.count; ++j) {
        const auto& one = all.items[j];
        const SectionMass mass = SectionMass::of(hair, one.section);
        const float shared = set.skeleton_weight[one.section] / contact.weight;
        if (one.point.is_envelope()) {
            const Vec3 d = half_line_direction(hair, hair.layout.slot(one.section), one.point.k());
            const float own = set.envelope_weight[one.section * k + one.point.k()] / contact.weight;
            w += Symmetric3::identity(mass.across * shared);
            w += Symmetric3::outer(mass.normal, mass.extra * shared);
            w += Symmetric3::outer(d, mass.envelope * own - mass.across * shared);
        } else {
            const float scale = one.compliance * shared;
            w += Symmetric3::identity(mass.across * scale);
            w += Symmetric3::outer(mass.normal, mass.extra * scale);
        }
    }
    if (!(w.trace() > 0)) return {}; // all of it is held by the head
    const ContactSide p = point_side(hair, contact), s = segment_side(hair, contact);
    const Vec3 approach = s.velocity - p.velocity;
    if (contact.kind == WispContactKind::friction) {
        const float dragged = 1 - static_cast<float>(exponential(-double(desc_.friction) *
                                                                 contact.density * friction_time));
        if (!(dragged > 1e-7f))
            return {};
        const Vec3 n = cross(p.direction, s.direction);
        const float angle_sine = length(n),
                    fade = smooth_step(angle_sine, 0.5f * sine_fade_, sine_fade_);
        const float out_of_plane = dragged + (1 - dragged) * fade;
        const float mean = w.trace() / 3;
        const float in = mean * (1 - dragged) / dragged,
                    out = mean * (1 - out_of_plane) / out_of_plane;
        w += Symmetric3::identity(in);
        if (fade > 0)
            w += Symmetric3::outer(n / angle_sine, out - in);
    }
    return w.solve(approach);
}

/// Adds up what the contacts do to one section, and changes its velocities.
void WispResponse::gather(const HairView& hair, const Set& set, std::size_t entry,
                          State& state) const {
    const std::uint32_t section = set.sections[entry];
    if (!hair.layout.simulated(section))
        return;
    const Slot slot = hair.layout.slot(section);
    const std::uint32_t k_count = hair.groom.envelope_points;
    const SectionMass mass = SectionMass::of(hair, section);

    Vec3 on_skeleton;
    float on_envelope[kMaxEnvelopePoints] = {};
    for (std::uint32_t i = set.first_share[entry]; i < set.first_share[entry + 1]; ++i) {
        const Share& share = set.shares[i];
        const Vec3& j = impulses_[share.contact];
        if (share.point.is_envelope()) { // M27
            const Vec3 d = half_line_direction(hair, slot, share.point.k());
            const float along = dot(d, j);
            on_envelope[share.point.k()] += along;
            on_skeleton += j - d * along;
        } else {
            on_skeleton += j * share.weight;
        }
    }
    const Vec3 change = mass.skeleton_response(on_skeleton);
    state.velocity.set(slot, state.velocity.vec(slot) + change);
    for (std::uint32_t k = 0; k < k_count; ++k)
        state.radius_rate.at(slot, k) +=
            on_envelope[k] * mass.envelope - dot(half_line_direction(hair, slot, k), change);
}

void WispResponse::apply(const HairView& hair, State& state, float friction_time,
                         Threads& threads) {
    const Set& set = friction_time > 0 ? all_ : collisions_;
    const auto chunks = [](std::size_t n, std::size_t per) { return (n + per - 1) / per; };
    threads.run(chunks(set.contacts.size(), kContactsPerChunk), [&](std::size_t chunk) {
        const std::size_t last = std::min(set.contacts.size(), (chunk + 1) * kContactsPerChunk);
        for (std::size_t i = chunk * kContactsPerChunk; i < last; ++i)
            impulses_[set.contacts[i]] =
                impulse(hair, set, contacts_[set.contacts[i]], friction_time);
    });
    threads.run(chunks(set.sections.size(), kSectionsPerChunk), [&](std::size_t chunk) {
        const std::size_t last = std::min(set.sections.size(), (chunk + 1) * kSectionsPerChunk);
        for (std::size_t e = chunk * kSectionsPerChunk; e < last; ++e)
            gather(hair, set, e, state);
    });
}

} // namespace mane
