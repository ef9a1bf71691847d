#include "interactions/wisp_response.h"

#include "base/functions.h"

#include <algorithm>
#include <numeric>

namespace mane {
namespace {

constexpr std::size_t kRanksPerChunk = 512;
constexpr std::uint32_t kQuad = 4;

std::uint32_t whole_quads(std::uint32_t contacts) {
    return (contacts + kQuad - 1) / kQuad * kQuad;
}

} // namespace

WispResponse::WispResponse(const WispContactDesc& desc, const std::string& instruction_set)
    : kernels_(wisp_answer_kernels(instruction_set)) {
    answers_.friction = double{desc.friction};
    answers_.sine_fade = sine_of_degrees(desc.fade_angle);
    answers_.sine_full = sine_of_degrees(double{desc.parallel_angle} * 2 / 3);
    answers_.sine_none = sine_of_degrees(desc.parallel_angle);
}

void WispResponse::take_masses(const HairView& hair, const ContactOrder& order) {
    for (std::uint32_t r = 0; r < order.size(); ++r) {
        const Slot slot = hair.layout.slot(order.section(r));
        answers_.inverse_mass.push_back({hair.rest.at(slot, Rest::inverse_mass_across),
                                         hair.rest.at(slot, Rest::inverse_mass_extra),
                                         hair.rest.at(slot, Rest::inverse_envelope_mass)});
    }
}

void WispResponse::engage(const HairView& hair, ContactGeometry& geometry,
                          std::span<const WispContact> contacts) {
    const ContactPoints& points = geometry.points();
    const std::size_t ranks = points.order.size();
    if (answers_.inverse_mass.empty())
        take_masses(hair, points.order);
    fill_slots(hair, geometry, contacts);
    share_masses(points);
    sort_by_section(points.order);
    answers_.near.assign(ranks, Four{});
    answers_.far.assign(ranks, Four{});
    answers_.change.resize(points.padded_ranks(), points.per_section - 1); // of others, none
    answers_.impulse.resize(answers_.place.size());
    for (AlignedVector<Four>& column : answers_.matrix)
        column.assign(answers_.place.size(), Four{}); // those of weight 0 stay
}

/// Segment by segment, contacts of points before those of axes, each in the order given.
void WispResponse::fill_slots(const HairView& hair, ContactGeometry& geometry,
                              std::span<const WispContact> contacts) {
    WispAnswers& a = answers_;
    const ContactPoints& points_now = geometry.points();
    const ContactOrder& order = points_now.order;
    contacts_.clear();
    for (const WispContact& c : contacts) {
        const std::uint32_t second = c.point.is_axis() ? c.section + 1 : c.section;
        if (hair.layout.simulated(second) || hair.layout.simulated(c.segment + 1))
            contacts_.push_back(c); // of others the head holds all
    }
    points_of_.start(order.size());
    axes_of_.start(order.size());
    for (const WispContact& c : contacts_)
        (c.point.is_axis() ? axes_of_ : points_of_).count(order.rank(c.segment));
    const std::uint32_t points = points_of_.add_up();
    by_segment_.resize(points + axes_of_.add_up());
    for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
        const std::uint32_t rank = order.rank(contacts_[i].segment);
        by_segment_[contacts_[i].point.is_axis() ? points + axes_of_.next(rank)
                                                 : points_of_.next(rank)] = i;
    }
    points_of_.finish();
    axes_of_.finish();

    a.first.resize(order.size() + 1);
    a.first_axis.resize(order.size());
    std::uint32_t slots = 0;
    for (std::uint32_t r = 0; r < order.size(); ++r) {
        a.first[r] = slots;
        a.first_axis[r] = slots += whole_quads(points_of_.last(r) - points_of_.first(r));
        slots += whole_quads(axes_of_.last(r) - axes_of_.first(r));
    }
    a.first.back() = slots;
    a.place.assign(slots, 0);
    a.rank.assign(slots, 0);
    for (AlignedVector<float>* numbers : {&a.s, &a.weight, &a.density})
        numbers->assign(slots, 0.f);
    a.axis_points.clear();
    slot_of_.resize(contacts_.size());
    for (std::uint32_t r = 0; r < order.size(); ++r) {
        for (std::uint32_t i = points_of_.first(r), slot = a.first[r]; i < points_of_.last(r); ++i)
            take_slot(points_now, slot++, by_segment_[i]);
        for (std::uint32_t i = axes_of_.first(r), slot = a.first_axis[r]; i < axes_of_.last(r); ++i)
            take_slot(points_now, slot++, by_segment_[points + i]);
    }
    geometry.add_points(a.axis_points.size());
}

void WispResponse::take_slot(const ContactPoints& points, std::uint32_t slot,
                             std::uint32_t contact) {
    WispAnswers& a = answers_;
    const WispContact& c = contacts_[contact];
    slot_of_[contact] = slot;
    const std::uint32_t rank = a.rank[slot] = points.order.rank(c.section);
    if (c.point.is_axis()) {
        a.place[slot] = points.places() + static_cast<std::uint32_t>(a.axis_points.size());
        a.axis_points.push_back({rank, slot, c.along});
    } else {
        a.place[slot] = points.place(rank, c.point.code);
    }
    a.s[slot] = c.s;
    a.weight[slot] = c.weight;
    a.density[slot] = c.kind == WispContactKind::friction ? c.density : 0.f;
}

/// Sums the weights of the contacts that share a mass: each skeleton point's, an envelope point's
/// contacts included, and each envelope point's own; and the inverse masses that they leave for a
/// contact (M27a): its part of a mass is its weight over their sum, where that is over 1.
void WispResponse::share_masses(const ContactPoints& points) {
    WispAnswers& a = answers_;
    const std::uint32_t ranks = points.order.size();
    together_.assign(points.places(), 0.f);
    a.takes_part.assign(ranks, 0);
    const auto use = [&](std::uint32_t rank, float weight) {
        together_[points.place(rank)] += weight;
        a.takes_part[rank] = 1;
    };
    for (const WispContact& c : contacts_) {
        const std::uint32_t rank = points.order.rank(c.section),
                            segment = points.order.rank(c.segment);
        use(rank, c.weight);
        if (c.point.is_axis())
            use(points.order.next(rank), c.weight);
        if (c.point.is_envelope())
            together_[points.place(rank, c.point.code)] += c.weight;
        use(segment, c.weight);
        use(points.order.next(segment), c.weight);
    }
    a.shared_across.resize(ranks);
    a.shared_extra.resize(ranks);
    a.shared_envelope.resize(points.places());
    for (std::uint32_t r = 0; r < ranks; ++r) {
        const WispAnswers::InverseMass& mass = a.inverse_mass[r];
        const float times = std::max(together_[points.place(r)], 1.f);
        a.shared_across[r] = mass.across * times;
        a.shared_extra[r] = mass.extra * times;
        for (std::uint32_t code = 1; code < points.per_section; ++code) {
            const std::uint32_t place = points.place(r, code); // M27: across it, its section's
            a.shared_envelope[place] =
                mass.envelope * std::max(together_[place], 1.f) - a.shared_across[r];
        }
    }
}

/// Section by section, the slots of the contacts at its points.
void WispResponse::sort_by_section(const ContactOrder& order) {
    WispAnswers& a = answers_;
    a.at_section.start(order.size());
    a.axes_at.start(order.size());
    for (const WispContact& c : contacts_) {
        const std::uint32_t rank = order.rank(c.section);
        if (!c.point.is_axis()) {
            a.at_section.count(rank);
            continue;
        }
        a.axes_at.count(rank);
        a.axes_at.count(order.next(rank));
    }
    a.entry.resize(a.at_section.add_up());
    a.axis_share.resize(a.axes_at.add_up());
    for (std::uint32_t i = 0; i < contacts_.size(); ++i) {
        const WispContact& c = contacts_[i];
        const std::uint32_t rank = order.rank(c.section), slot = slot_of_[i];
        if (!c.point.is_axis()) {
            a.entry[a.at_section.next(rank)] = slot * 16 + c.point.code;
            continue;
        }
        a.axis_share[a.axes_at.next(rank)] = {slot, 1 - c.along};
        a.axis_share[a.axes_at.next(order.next(rank))] = {slot, c.along};
    }
    a.at_section.finish();
    a.axes_at.finish();
}

void WispResponse::prepare(const ContactGeometry& geometry, float step, Threads& threads) {
    answers_.step = step;
    threads.run_ranges(geometry.points().order.size(), kRanksPerChunk,
                       [&](std::size_t first, std::size_t last) {
                           kernels_.find_matrices(geometry.points(), answers_, first, last);
                       });
}

void WispResponse::apply(const HairView& hair, ContactGeometry& geometry, State& state,
                         Threads& threads) {
    const ContactPoints& points = geometry.points();
    geometry.take_velocities(hair, threads);
    take_axis_velocities(geometry);
    threads.run_ranges(points.order.size(), kRanksPerChunk,
                       [&](std::size_t first, std::size_t last) {
                           kernels_.find_impulses(points, answers_, first, last);
                       });
    threads.run_ranges(points.order.size(), kRanksPerChunk,
                       [&](std::size_t first, std::size_t last) {
                           kernels_.find_changes(points, answers_, first, last);
                       });
    geometry.add_to(state, hair.layout, answers_.change, threads);
}

/// Of the points of axis contacts, from their segments' ends.
void WispResponse::take_axis_velocities(ContactGeometry& geometry) const {
    const ContactPoints& points = geometry.points();
    Four* velocity = geometry.velocities();
    std::uint32_t at = points.places();
    for (const AxisPoint& point : answers_.axis_points)
        velocity[at++] = velocity[points.place(point.rank)] * four(1 - point.along) +
                         velocity[points.place(points.order.next(point.rank))] * four(point.along);
}

void WispResponse::list(std::vector<Contact>& contacts) const {
    std::vector<std::uint32_t> order(contacts_.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return before(contacts_[a], contacts_[b]); });
    for (const std::uint32_t i : order) {
        const WispContact& c = contacts_[i];
        contacts.push_back({.kind = c.kind == WispContactKind::friction ? ContactKind::friction
                                                                        : ContactKind::collision,
                            .point = c.point.is_axis() ? Contact::kBetween : c.point.code,
                            .section = c.section,
                            .along = c.along,
                            .other = c.segment,
                            .other_along = c.s,
                            .impulse = first_three(answers_.impulse[slot_of_[i]])});
    }
}

} // namespace mane
