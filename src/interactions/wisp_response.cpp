#include "interactions/wisp_response.h"

#include "base/functions.h"
#include "interactions/wisp_detection.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr std::size_t kAnswersPerChunk = 1024;
constexpr std::size_t kParticipantsPerChunk = 256;
constexpr std::uint32_t kNone = 0xffffffffu;
constexpr ContactPoint kSkeletonPoint{ContactPoint::kSkeleton};

/// 3τ² − 2τ³, from 0 at `low` to 1 at `high`.
float smooth_step(float x, float low, float high) {
    const float t = std::clamp((x - low) / (high - low), 0.f, 1.f);
    return t * t * (3 - 2 * t);
}

/// A contact's part of a mass that contacts of this weight together share (M27a).
double part(const WispContact& contact, float together) {
    return double{contact.weight} / std::max(together, 1.f);
}

/// Calls `work` with every index below `count`, in chunks.
template <typename Work>
void for_each(Threads& threads, std::size_t count, std::size_t per_chunk, Work&& work) {
    threads.run((count + per_chunk - 1) / per_chunk, [&](std::size_t chunk) {
        const std::size_t last = std::min(count, (chunk + 1) * per_chunk);
        for (std::size_t i = chunk * per_chunk; i < last; ++i)
            work(i);
    });
}

} // namespace

WispResponse::WispResponse(const WispContactDesc& desc)
    : desc_(desc), sine_fade_(static_cast<float>(sine(desc.fade_angle * (kPi / 180)))),
      sine_full_(sine(desc.parallel_angle * (kPi / 180) * 2 / 3)),
      sine_none_(sine(desc.parallel_angle * (kPi / 180))) {}

void WispResponse::engage(const HairView& hair, std::span<const WispContact> contacts) {
    contacts_.clear();
    answers_.clear();
    participants_.clear();
    participant_of_.assign(hair.groom.section_count(), kNone);
    for (const WispContact& contact : contacts)
        add_answer(hair, contact);
    add_shares();
    impulses_.resize(answers_.size());
    velocities_.resize(participants_.size());
    radius_rates_.resize(participants_.size() * hair.groom.envelope_points);
}

std::uint32_t WispResponse::participant(std::uint32_t section) {
    std::uint32_t& index = participant_of_[section];
    if (index == kNone) {
        index = static_cast<std::uint32_t>(participants_.size());
        participants_.emplace_back().section = section;
    }
    return index;
}

void WispResponse::add_answer(const HairView& hair, const WispContact& contact) {
    const bool axis = contact.point.is_axis();
    const std::uint32_t second = axis ? contact.section + 1 : contact.section;
    if (!hair.layout.simulated(second) && !hair.layout.simulated(contact.segment + 1))
        return; // the head holds all of it

    // Next to an end that the head holds, a contact at small s would fling the other end at 1/s of
    // its velocity: there the weight counts once. That is a viscosity in series, so energy still
    // falls.
    const auto far = [&](std::uint32_t segment, float s) {
        return hair.layout.simulated(segment) ? s * s : s;
    };
    const float a = axis ? contact.along : 0.f, s = contact.s;
    Answer answer;
    answer.point = contact.point;
    answer.ends[0] = {participant(contact.section), 1 - a, (1 - a) * (1 - a)};
    answer.ends[1] = {participant(second), a, axis ? far(contact.section, a) : 0.f};
    answer.ends[2] = {participant(contact.segment), s - 1, (1 - s) * (1 - s)};
    answer.ends[3] = {participant(contact.segment + 1), -s, far(contact.segment, s)};
    for (int i = 0; i < 4; ++i) {
        if (i == 1 && !axis)
            continue;
        Participant& p = participants_[answer.ends[i].participant];
        ++p.shares;
        p.skeleton_weight += contact.weight;
    }
    if (contact.point.is_envelope())
        participants_[answer.ends[0].participant].envelope_weight[contact.point.k()] +=
            contact.weight;
    contacts_.push_back(contact);
    answers_.push_back(answer);
}

/// Shares by participant, in the order of contacts: places by their counts, then filled.
void WispResponse::add_shares() {
    std::uint32_t next = 0;
    for (Participant& p : participants_) {
        p.first_share = p.last_share = next;
        next += p.shares;
    }
    shares_.resize(next);
    for (std::uint32_t i = 0; i < answers_.size(); ++i) {
        const Answer& answer = answers_[i];
        for (int e = 0; e < 4; ++e) {
            if (e == 1 && !answer.point.is_axis())
                continue;
            const ContactPoint point =
                e == 0 && answer.point.is_envelope() ? answer.point : kSkeletonPoint;
            shares_[participants_[answer.ends[e].participant].last_share++] = {
                i, answer.ends[e].weight, point};
        }
    }
}

void WispResponse::prepare(const HairView& hair, float step, Threads& threads) {
    for_each(threads, participants_.size(), kParticipantsPerChunk, [&](std::size_t i) {
        Participant& p = participants_[i];
        p.mass = SectionMass::of(hair, p.section);
        for (std::uint32_t k = 0; k < hair.groom.envelope_points; ++k)
            p.half_lines[k] = half_line_direction(hair, hair.layout.slot(p.section), k);
    });
    for_each(threads, answers_.size(), kAnswersPerChunk, [&](std::size_t i) {
        answers_[i].impulse_per_velocity =
            Symmetric3(impulse_per_velocity(hair, contacts_[i], answers_[i], step));
    });
}

Symmetric3d WispResponse::impulse_per_velocity(const HairView& hair, const WispContact& contact,
                                               const Answer& answer, float step) const {
    Symmetric3d w;
    for (const End& end : answer.ends) {
        const Participant& p = participants_[end.participant];
        const double shared = end.compliance / part(contact, p.skeleton_weight);
        w += Symmetric3d::identity(p.mass.across * shared);
        w += Symmetric3d::outer(Vec3d(p.mass.normal), p.mass.extra * shared);
    }
    if (answer.point.is_envelope()) { // along its half line it moves with its own mass
        const Participant& p = participants_[answer.ends[0].participant];
        const std::uint32_t k = answer.point.k();
        w += Symmetric3d::outer(Vec3d(p.half_lines[k]),
                                p.mass.envelope / part(contact, p.envelope_weight[k]) -
                                    p.mass.across / part(contact, p.skeleton_weight));
    }
    if (!(w.trace() > 0))
        return {};
    if (contact.kind == WispContactKind::friction)
        w += viscosity(hair, contact, w, step);
    return w.inverse();
}

/// Z of quasi-parallel wisps (M24, M25): weak in their plane, rigid across it as far as there is a
/// plane.
Symmetric3d WispResponse::viscosity(const HairView& hair, const WispContact& contact,
                                    const Symmetric3d& w, float step) const {
    constexpr double kLeastDrag = 1e-6; // no friction at all would be an infinite Z
    const double dragged =
        std::max(kLeastDrag, 1 - exponential(-double{desc_.friction} * contact.density * step));
    const Vec3d n = cross(Vec3d(point_side(hair, contact).direction),
                          Vec3d(segment_side(hair, contact).direction));
    const double sine_of_angle = length(n);
    const double fade =
        smooth_step(static_cast<float>(sine_of_angle), 0.5f * sine_fade_, sine_fade_);
    const double out_of_plane = dragged + (1 - dragged) * fade;
    const double mean = w.trace() / 3;
    const double in = mean * sliding_weight(sine_of_angle) * (1 - dragged) / dragged,
                 out = mean * (1 - out_of_plane) / out_of_plane;
    Symmetric3d z = Symmetric3d::identity(in);
    if (fade > 0)
        z += Symmetric3d::outer(n / sine_of_angle, out - in);
    return z;
}

/// Sliding ends smoothly at the parallel angle, where the pair becomes a collision: a wisp that
/// leans on another would else be dropped where the other's next segment turns.
double WispResponse::sliding_weight(double sine_of_angle) const {
    const double t = std::clamp((sine_none_ - sine_of_angle) / (sine_none_ - sine_full_), 0.0, 1.0);
    return t * t;
}

void WispResponse::apply(const HairView& hair, State& state, Threads& threads) {
    const std::uint32_t k_count = hair.groom.envelope_points;
    for (std::size_t i = 0; i < participants_.size(); ++i) {
        const Slot slot = hair.layout.slot(participants_[i].section);
        velocities_[i] = state.velocity.vec(slot);
        for (std::uint32_t k = 0; k < k_count; ++k)
            radius_rates_[i * k_count + k] = state.radius_rate.at(slot, k);
    }
    for_each(threads, answers_.size(), kAnswersPerChunk,
             [&](std::size_t i) { impulses_[i] = impulse(answers_[i], k_count); });
    for_each(threads, participants_.size(), kParticipantsPerChunk, [&](std::size_t i) {
        if (hair.layout.simulated(participants_[i].section))
            gather(hair, participants_[i], state);
    });
}

Vec3 WispResponse::impulse(const Answer& answer, std::uint32_t k_count) const {
    Vec3 relative;
    for (const End& end : answer.ends)
        relative += velocities_[end.participant] * end.weight;
    if (answer.point.is_envelope()) {
        const std::uint32_t p = answer.ends[0].participant, k = answer.point.k();
        relative += participants_[p].half_lines[k] * radius_rates_[p * k_count + k];
    }
    return -(answer.impulse_per_velocity * relative);
}

/// Adds up what the contacts do to one section, and changes its velocities.
void WispResponse::gather(const HairView& hair, const Participant& participant,
                          State& state) const {
    Vec3 on_skeleton;
    float on_envelope[kMaxEnvelopePoints] = {};
    for (std::uint32_t i = participant.first_share; i < participant.last_share; ++i) {
        const Share& share = shares_[i];
        const Vec3& j = impulses_[share.answer];
        if (share.point.is_envelope()) { // M27
            const Vec3& d = participant.half_lines[share.point.k()];
            const float along = dot(d, j);
            on_envelope[share.point.k()] += along;
            on_skeleton += j - d * along;
        } else {
            on_skeleton += j * share.weight;
        }
    }
    const Slot slot = hair.layout.slot(participant.section);
    const Vec3 change = participant.mass.skeleton_response(on_skeleton);
    state.velocity.set(slot, state.velocity.vec(slot) + change);
    for (std::uint32_t k = 0; k < hair.groom.envelope_points; ++k)
        state.radius_rate.at(slot, k) +=
            on_envelope[k] * participant.mass.envelope - dot(participant.half_lines[k], change);
}

} // namespace mane
