#include "interactions/wisp_response.h"

#include "base/functions.h"
#include "base/room.h"

#include <algorithm>

namespace mane {
namespace {

constexpr std::size_t kRanksPerChunk = 512;
constexpr std::uint32_t kQuad = 4;
/// [1/s] As good as none, but a contact that slides needs some: 0 stands for a collision.
constexpr float kLeastFriction = 1e-6f;

std::uint32_t whole_quads(std::uint32_t contacts) {
    return (contacts + kQuad - 1) / kQuad * kQuad;
}

} // namespace

WispResponse::WispResponse(const WispContactDesc& desc, const std::string& instruction_set)
    : kernels_(wisp_answer_kernels(instruction_set)) {
    change(desc);
}

void WispResponse::change(const WispContactDesc& desc) {
    answers_.friction = double{std::max(desc.friction, kLeastFriction)};
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

void WispResponse::engage(const HairView& hair, ContactGeometry& geometry, const ContactList& list,
                          Threads& threads) {
    WispAnswers& a = answers_;
    const ContactPoints& points = geometry.points();
    const std::size_t ranks = points.order.size();
    if (a.inverse_mass.empty()) {
        take_masses(hair, points.order);
        a.shared_envelope.resize(points.places());
        a.change.resize(points.padded_ranks(), points.per_section - 1);
    }
    list_ = &list;
    lay_out_slots(points.order);
    geometry.add_points(list.axes.size());
    take_axis_points(points);
    threads.run_ranges(ranks, kRanksPerChunk, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r)
            fill_segment(points, static_cast<std::uint32_t>(r));
    });
    sort_by_section(points, threads);
    sort_axes(points.order);
    threads.run_ranges(ranks, kRanksPerChunk, [&](std::size_t first, std::size_t last) {
        for (std::size_t r = first; r < last; ++r)
            share_mass(points, static_cast<std::uint32_t>(r));
    });
}

/// Makes room: segment by segment, contacts of points before those of axes.
void WispResponse::lay_out_slots(const ContactOrder& order) {
    WispAnswers& a = answers_;
    const std::uint32_t ranks = order.size();
    axes_of_.start(ranks);
    for (const WispContact& c : list_->axes)
        axes_of_.count(order.rank(c.segment));
    make_room(by_segment_, axes_of_.add_up());
    for (std::uint32_t i = 0; i < list_->axes.size(); ++i)
        by_segment_[axes_of_.next(order.rank(list_->axes[i].segment))] = i;
    axes_of_.finish();

    a.first.resize(ranks + 1);
    a.first_axis.resize(ranks);
    std::uint32_t slots = 0;
    for (std::uint32_t r = 0; r < ranks; ++r) {
        a.first[r] = slots;
        a.first_axis[r] = slots += whole_quads(static_cast<std::uint32_t>(list_->inside[r].size()));
        slots += whole_quads(axes_of_.last(r) - axes_of_.first(r));
    }
    a.first[ranks] = slots;
    for (AlignedVector<std::uint32_t>* numbers : {&a.place, &a.point})
        make_room(*numbers, slots);
    for (AlignedVector<float>* numbers : {&a.weight, &a.density})
        make_room(*numbers, slots);
    for (AlignedVector<Four>* fours : {&a.diagonal, &a.beside, &a.impulse})
        make_room(*fours, slots);
    a.shared_across.resize(ranks);
    a.shared_extra.resize(ranks);
    a.takes_part.resize(ranks);
    a.near.resize(ranks);
    a.far.resize(ranks);
    on_segment_.resize(ranks);
}

void WispResponse::fill_segment(const ContactPoints& points, std::uint32_t rank) {
    WispAnswers& a = answers_;
    std::uint32_t slot = a.first[rank];
    float sum = 0;
    const auto take = [&](float s, float density, float weight) {
        a.diagonal[slot][3] = s;
        a.density[slot] = density;
        a.weight[slot++] = weight;
        sum += weight;
    };
    for (const PointContact& c : list_->inside[rank]) {
        a.place[slot] = points.place(c.rank(), c.code());
        a.point[slot] = c.point;
        take(c.s, std::max(c.density, 0.f), c.weight);
    }
    fill_up(slot, a.first_axis[rank]);
    slot = a.first_axis[rank];
    for (std::uint32_t i = axes_of_.first(rank); i < axes_of_.last(rank); ++i) {
        const WispContact& c = list_->axes[by_segment_[i]];
        a.place[slot] = points.places() + by_segment_[i];
        a.point[slot] = 0;
        a.axis_points[by_segment_[i]].slot = slot;
        take(c.s, c.kind == WispContactKind::friction ? c.density : 0.f, c.weight);
    }
    fill_up(slot, a.first[rank + 1]);
    on_segment_[rank] = sum;
    a.near[rank] = a.far[rank] = Four{};
}

/// With slots that answer nothing.
void WispResponse::fill_up(std::uint32_t slot, std::uint32_t end) {
    WispAnswers& a = answers_;
    for (; slot < end; ++slot) {
        a.place[slot] = a.point[slot] = 0;
        a.weight[slot] = a.density[slot] = 0;
        a.diagonal[slot] = a.beside[slot] = Four{};
    }
}

void WispResponse::take_axis_points(const ContactPoints& points) {
    answers_.axis_points.clear();
    for (const WispContact& c : list_->axes)
        answers_.axis_points.push_back({points.order.rank(c.section), 0, c.along});
}

/// Section by section, the slots of the contacts at its points; behind all, those that have none.
void WispResponse::sort_by_section(const ContactPoints& points, Threads& threads) {
    WispAnswers& a = answers_;
    const std::uint32_t ranks = points.order.size(), slots = a.first[ranks];
    make_room(a.entry, std::size_t{slots} + 32);
    a.at_section.sort(
        threads, std::size_t{ranks} + 1, slots,
        [&](std::size_t slot) {
            const bool at_point = a.weight[slot] > 0 && a.place[slot] < points.places();
            return at_point ? a.point[slot] / 16 : ranks;
        },
        [&](std::size_t slot, std::uint32_t at) {
            a.entry[at] = static_cast<std::uint32_t>(slot) * 16 + a.point[slot] % 16;
        });
}

/// The same for the points of axes, which hang on two sections.
void WispResponse::sort_axes(const ContactOrder& order) {
    WispAnswers& a = answers_;
    a.axes_at.start(order.size());
    for (const AxisPoint& point : a.axis_points) {
        a.axes_at.count(point.rank);
        a.axes_at.count(order.next(point.rank));
    }
    make_room(a.axis_share, a.axes_at.add_up());
    for (const AxisPoint& point : a.axis_points) {
        a.axis_share[a.axes_at.next(point.rank)] = {point.slot, 1 - point.along};
        a.axis_share[a.axes_at.next(order.next(point.rank))] = {point.slot, point.along};
    }
    a.axes_at.finish();
}

/// Sums the weights of the contacts that share a section's masses: its skeleton point's, an
/// envelope point's contacts included, and each envelope point's own; and finds the inverse masses
/// that they leave for a contact (M27a): its part of a mass is its weight over their sum, where
/// that is over 1.
void WispResponse::share_mass(const ContactPoints& points, std::uint32_t rank) {
    WispAnswers& a = answers_;
    const std::uint32_t before = points.order.before(rank);
    float together[kMaxEnvelopePoints + 1] = {};
    float sum = on_segment_[rank] + (before != ContactOrder::kNone ? on_segment_[before] : 0.f);
    for (std::uint32_t i = a.at_section.first(rank); i < a.at_section.last(rank); ++i) {
        const float weight = a.weight[a.entry[i] / 16];
        sum += weight;
        together[a.entry[i] % 16] += weight;
    }
    for (std::uint32_t i = a.axes_at.first(rank); i < a.axes_at.last(rank); ++i)
        sum += a.weight[a.axis_share[i].slot];
    a.takes_part[rank] = sum > 0;

    const WispAnswers::InverseMass& mass = a.inverse_mass[rank];
    a.shared_across[rank] = mass.across * std::max(sum, 1.f);
    a.shared_extra[rank] = mass.extra * std::max(sum, 1.f);
    for (std::uint32_t code = 1; code < points.per_section; ++code) // M27: across it, its section's
        a.shared_envelope[points.place(rank, code)] =
            mass.envelope * std::max(together[code], 1.f) - a.shared_across[rank];
    a.change.skeleton[rank] = Four{};
    for (std::uint32_t f = 0; f < a.change.fours; ++f)
        a.change.rate[std::size_t{rank} * a.change.fours + f] = Four{};
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

void WispResponse::list(const HairView& hair, const ContactOrder& order,
                        std::vector<Contact>& contacts) const {
    if (!list_)
        return;
    const auto can_move = [&](const WispContact& c) { // of others the head holds all
        const std::uint32_t second = c.point.is_axis() ? c.section + 1 : c.section;
        return hair.layout.simulated(second) || hair.layout.simulated(c.segment + 1);
    };
    struct Answered {
        WispContact contact;
        std::uint32_t slot;
    };
    std::vector<Answered> answered;
    const std::vector<WispContact> all = list_->all(order);
    std::size_t next = 0;
    for (std::uint32_t rank = 0; rank < list_->inside.size(); ++rank)
        for (std::uint32_t i = 0; i < list_->inside[rank].size(); ++i)
            answered.push_back({all[next++], answers_.first[rank] + i});
    for (std::uint32_t i = 0; i < list_->axes.size(); ++i)
        answered.push_back({all[next++], answers_.axis_points[i].slot});
    std::erase_if(answered, [&](const Answered& a) { return !can_move(a.contact); });
    std::sort(answered.begin(), answered.end(),
              [](const Answered& a, const Answered& b) { return before(a.contact, b.contact); });
    for (const auto& [c, slot] : answered)
        contacts.push_back({.kind = c.kind == WispContactKind::friction ? ContactKind::friction
                                                                        : ContactKind::collision,
                            .point = c.point.is_axis() ? Contact::kBetween : c.point.code,
                            .section = c.section,
                            .along = c.along,
                            .other = c.segment,
                            .other_along = c.s,
                            .impulse = first_three(answers_.impulse[slot])});
}

} // namespace mane
