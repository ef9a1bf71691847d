#include "interactions/wisp_response.h"

#include <algorithm>

namespace mane {
namespace {

constexpr std::size_t kAnswersPerChunk = 2048;
constexpr std::size_t kSectionsPerChunk = 512;
constexpr std::size_t kWispsPerChunk = 64;

/// A contact's part of a mass that contacts of this weight together share (M27a).
float part(const WispContact& contact, float together) {
    return contact.weight / std::max(together, 1.f);
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

WispResponse::WispResponse(const WispContactDesc& desc) : desc_(desc) {}

void WispResponse::engage(const HairView& hair, std::span<const WispContact> contacts) {
    places_ = hair.groom.envelope_points + 1;
    sort_by_place(hair, contacts);
    weigh();
    share_segments();

    const std::size_t sections = hair.groom.section_count();
    sections_.clear();
    wisp_takes_part_.assign(hair.groom.wisp_count(), 0);
    for (std::uint32_t s = 0; s < sections; ++s) {
        if (!takes_part_[s])
            continue;
        sections_.push_back(s);
        wisp_takes_part_[hair.layout.wisp_of(s)] = 1;
    }
    answers_.resize(contacts_.size());
    impulses_.resize(contacts_.size());
    mass_.resize(sections);
    segment_direction_.resize(sections);
    half_line_.resize(sections * places_);
    velocity_.resize(sections * places_);
}

/// Contacts at points by their place, then those of axes; each in the order given.
void WispResponse::sort_by_place(const HairView& hair, std::span<const WispContact> contacts) {
    const auto can_move = [&](const WispContact& c) { // or the head holds all of it
        const std::uint32_t second = c.point.is_axis() ? c.section + 1 : c.section;
        return hair.layout.simulated(second) || hair.layout.simulated(c.segment + 1);
    };
    answers_at_.start(std::size_t{hair.groom.section_count()} * places_);
    std::size_t axes = 0;
    for (const WispContact& c : contacts) {
        if (!can_move(c))
            continue;
        if (c.point.is_axis())
            ++axes;
        else
            answers_at_.count(place(c.section, c.point));
    }
    axes_ = answers_at_.add_up();
    contacts_.resize(axes_ + axes);
    std::size_t next_axis = axes_;
    for (const WispContact& c : contacts)
        if (can_move(c))
            contacts_[c.point.is_axis() ? next_axis++
                                        : answers_at_.next(place(c.section, c.point))] = c;
    answers_at_.finish();
}

/// Sums the weights of the contacts that share a mass: each skeleton point's, an envelope point's
/// contacts included, and each envelope point's own.
void WispResponse::weigh() {
    weight_.assign(answers_at_.size(), 0.f);
    takes_part_.assign(weight_.size() / places_, 0);
    const auto use = [this](std::uint32_t section, float weight) {
        weight_[place(section)] += weight;
        takes_part_[section] = 1;
    };
    for (const WispContact& c : contacts_) {
        use(c.section, c.weight);
        if (c.point.is_axis())
            use(c.section + 1, c.weight);
        if (c.point.is_envelope())
            weight_[place(c.section, c.point)] += c.weight;
        use(c.segment, c.weight);
        use(c.segment + 1, c.weight);
    }
}

/// Segment by segment, the answers that push its ends.
void WispResponse::share_segments() {
    shares_of_.start(takes_part_.size());
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        shares_of_.count(contacts_[i].segment);
        if (i >= axes_)
            shares_of_.count(contacts_[i].section);
    }
    shares_.resize(shares_of_.add_up());
    for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
        const WispContact& c = contacts_[i];
        shares_[shares_of_.next(c.segment)] = {i, c.s - 1, -c.s};
        if (i >= axes_)
            shares_[shares_of_.next(c.section)] = {i, 1 - c.along, c.along};
    }
    shares_of_.finish();
}

void WispResponse::prepare(const HairView& hair, float step, Threads& threads) {
    for_each(threads, sections_.size(), kSectionsPerChunk,
             [&](std::size_t i) { take_section(hair, sections_[i]); });
    const ContactMatrix matrix(desc_, step);
    for_each(threads, answers_.size(), kAnswersPerChunk, [&](std::size_t i) {
        const WispContact& c = contacts_[i];
        const Symmetric3 m(matrix.impulse_per_velocity(input_of(hair, c)));
        Answer& answer = answers_[i];
        answer.column[0] = Four{m.xx, m.xy, m.xz, 0};
        answer.column[1] = Four{m.xy, m.yy, m.yz, 0};
        answer.column[2] = Four{m.xz, m.yz, m.zz, 0};
        answer.point = c.point.is_axis() ? place(c.section) : place(c.section, c.point);
        answer.segment = place(c.segment);
        answer.s = c.s;
        answer.along = c.along;
    });
}

void WispResponse::take_section(const HairView& hair, std::uint32_t section) {
    const Slot slot = hair.layout.slot(section);
    mass_[section] = SectionMass::of(hair, section);
    for (std::uint32_t k = 0; k + 1 < places_; ++k)
        half_line_[place(section, ContactPoint::envelope(k))] =
            four(half_line_direction(hair, slot, k));
    // Of a segment that takes part, both ends do; past a tip it is never asked for.
    if (section + 1 < takes_part_.size() && takes_part_[section + 1])
        segment_direction_[section] = normalized(
            hair.state.position.vec(hair.layout.slot(section + 1)) - hair.state.position.vec(slot));
}

ContactInput WispResponse::input_of(const HairView& hair, const WispContact& contact) const {
    const bool axis = contact.point.is_axis();
    const auto end = [&](std::uint32_t section, float square) {
        return ContactEnd{&mass_[section], square / part(contact, weight_[place(section)])};
    };
    // Next to an end that the head holds, a contact at small s would fling the other end at 1/s of
    // its velocity: there the weight counts once. That is a viscosity in series, so energy still
    // falls.
    const auto far = [&](std::uint32_t segment, float s) {
        return hair.layout.simulated(segment) ? s * s : s;
    };
    const float a = contact.along, s = contact.s;
    ContactInput input;
    input.ends[0] = end(contact.section, (1 - a) * (1 - a));
    if (axis)
        input.ends[1] = end(contact.section + 1, far(contact.section, a));
    input.ends[2] = end(contact.segment, (1 - s) * (1 - s));
    input.ends[3] = end(contact.segment + 1, far(contact.segment, s));
    if (contact.point.is_envelope()) {
        const std::uint32_t at = place(contact.section, contact.point);
        input.half_line = first_three(half_line_[at]);
        input.envelope = mass_[contact.section].envelope / part(contact, weight_[at]);
    }
    input.friction = contact.kind == WispContactKind::friction;
    input.density = contact.density;
    input.point_direction =
        axis ? segment_direction_[contact.section] : mass_[contact.section].normal;
    input.segment_direction = segment_direction_[contact.segment];
    return input;
}

void WispResponse::apply(const HairView& hair, State& state, Threads& threads) {
    for_each(threads, sections_.size(), kSectionsPerChunk,
             [&](std::size_t i) { take_velocities(hair, state, sections_[i]); });
    for_each(threads, answers_.size(), kAnswersPerChunk, [&](std::size_t i) {
        impulses_[i] = i < axes_ ? impulse(answers_[i]) : axis_impulse(answers_[i]);
    });
    for_each(threads, hair.groom.wisp_count(), kWispsPerChunk, [&](std::size_t w) {
        if (wisp_takes_part_[w])
            answer_wisp(hair, w, state);
    });
}

void WispResponse::take_velocities(const HairView& hair, const State& state,
                                   std::uint32_t section) {
    const Slot slot = hair.layout.slot(section);
    Four* at = &velocity_[place(section)];
    const Four* half_line = &half_line_[place(section)];
    at[0] = four(state.velocity.vec(slot));
    for (std::uint32_t k = 0; k + 1 < places_; ++k)
        at[k + 1] = at[0] + half_line[k + 1] * four(state.radius_rate.at(slot, k));
}

namespace {

Four minus_product(const Four* column, const Four& v) {
    return -(column[0] * four(v[0]) + column[1] * four(v[1]) + column[2] * four(v[2]));
}
Four between(const Four& a, const Four& b, float s) {
    return a * four(1 - s) + b * four(s);
}

} // namespace

Four WispResponse::impulse(const Answer& answer) const {
    const Four* segment = &velocity_[answer.segment];
    return minus_product(answer.column,
                         velocity_[answer.point] - between(segment[0], segment[places_], answer.s));
}

Four WispResponse::axis_impulse(const Answer& answer) const {
    const Four *point = &velocity_[answer.point], *segment = &velocity_[answer.segment];
    return minus_product(answer.column, between(point[0], point[places_], answer.along) -
                                            between(segment[0], segment[places_], answer.s));
}

/// From root to tip: a section is the near end of one segment and the far end of the one before.
void WispResponse::answer_wisp(const HairView& hair, std::size_t wisp, State& state) const {
    Four far{};
    for (std::uint32_t s = hair.groom.first_section[wisp]; s < hair.groom.first_section[wisp + 1];
         ++s) {
        Four near = far;
        far = Four{};
        for (std::uint32_t i = shares_of_.first(s); i < shares_of_.last(s); ++i) {
            const Four& j = impulses_[shares_[i].answer];
            near += j * four(shares_[i].near);
            far += j * four(shares_[i].far);
        }
        if (takes_part_[s] && hair.layout.simulated(s))
            push_section(hair, s, near, state);
    }
}

/// Changes a section's velocities: by what its segments' contacts give its skeleton point, and by
/// those of its own points, of which an envelope point takes the part along its half line and the
/// skeleton point the rest (M27).
void WispResponse::push_section(const HairView& hair, std::uint32_t section, Four on_skeleton,
                                State& state) const {
    const std::uint32_t at = place(section);
    float on_envelope[kMaxEnvelopePoints] = {};
    for (std::uint32_t c = 0; c < places_; ++c) {
        Four sum{};
        for (std::uint32_t i = answers_at_.first(at + c); i < answers_at_.last(at + c); ++i)
            sum += impulses_[i];
        on_skeleton += sum;
        if (c == 0)
            continue;
        const float along = dot(half_line_[at + c], sum);
        on_envelope[c - 1] = along;
        on_skeleton -= half_line_[at + c] * four(along);
    }
    const SectionMass& mass = mass_[section];
    const Slot slot = hair.layout.slot(section);
    const Vec3 change = mass.skeleton_response(first_three(on_skeleton));
    state.velocity.set(slot, state.velocity.vec(slot) + change);
    const Four by = four(change);
    for (std::uint32_t k = 0; k + 1 < places_; ++k)
        state.radius_rate.at(slot, k) +=
            on_envelope[k] * mass.envelope - dot(half_line_[at + k + 1], by);
}

void WispResponse::list(std::vector<Contact>& contacts) const {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
        const WispContact& c = contacts_[i];
        contacts.push_back({.kind = c.kind == WispContactKind::friction ? ContactKind::friction
                                                                        : ContactKind::collision,
                            .point = c.point.is_axis() ? Contact::kBetween : c.point.code,
                            .section = c.section,
                            .along = c.along,
                            .other = c.segment,
                            .other_along = c.s,
                            .impulse = first_three(impulses_[i])});
    }
}

} // namespace mane
