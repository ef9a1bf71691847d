#include "interactions/character_response.h"

#include "base/functions.h"
#include "interactions/character_contact.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace mane {
namespace {

constexpr std::size_t kWispsPerChunk = 64;
/// A wisp's contacts are gone through until no impulse changes a velocity by more than this [m/s],
/// far under what shows.
constexpr float kSettled = 1e-6f;
/// At most so many times: a section held by several planes settles by about half each time.
constexpr int kSweeps = 24;
constexpr std::size_t kNone = ~std::size_t{0};

} // namespace

template <int kFours>
void SlidingResponse<kFours>::begin(const HairView& hair, const SlidingStep& step) {
    wisp_.begin(hair);
    step_ = step;
}

template <int kFours>
void SlidingResponse<kFours>::answer(std::uint32_t number, std::span<const SlidingContact> contacts,
                                     State& state, std::vector<Vec3>& impulses) {
    impulses.assign(contacts.size(), {});
    contacts_ = contacts;
    load(number);
    find_planes();
    if (idle())
        return;
    drag();
    stop_approach();
    wisp_.store(state);
    for (std::size_t c = 0; c < planes_.size(); ++c)
        impulses[c] =
            first_three(planes_[c].normal * four(planes_[c].impulse) + planes_[c].dragged);
}

template <int kFours> void SlidingResponse<kFours>::load(std::uint32_t number) {
    first_ = contacts_.front().point.section;
    end_ = first_ + 1;
    for (const SlidingContact& contact : contacts_)
        end_ = std::max(end_, contact.point.section + contact.point.sections());
    wisp_.load(number, first_, end_);
}

template <int kFours> void SlidingResponse<kFours>::find_planes() {
    planes_.resize(contacts_.size());
    for (std::size_t c = 0; c < contacts_.size(); ++c)
        find_plane(contacts_[c], planes_[c]);
}

template <int kFours>
void SlidingResponse<kFours>::find_plane(const SlidingContact& contact, Plane& plane) const {
    const Four passed = four(step_.fraction), normal_change = four(contact.normal_change),
               anchor_change = four(contact.anchor_change);
    const Four way = four(contact.normal) + normal_change * passed;
    const float inverse_size = 1 / std::sqrt(dot(way, way)), per_second = 1 / step_.duration;
    plane.normal = way * four(inverse_size);
    const Four from_anchor =
        wisp_.position(contact.point) - (four(contact.anchor) + anchor_change * passed);
    plane.distance = dot(from_anchor, plane.normal);
    // The plane moves with its anchor and turns: d/dt (p − a)·n = (v − ȧ)·n + (p − a)·ṅ with ṅ
    // across n.
    const Four turn = normal_change - plane.normal * four(dot(normal_change, plane.normal));
    const float turning = dot(from_anchor, turn) * (inverse_size * per_second);
    plane.velocity = anchor_change * four(per_second) - plane.normal * four(turning);
    if (!step_.polygons_move)
        plane.velocity = Four{};
    // Nothing may pass the threshold within a step, ours: at 5 m/s a step of 1 ms is wider than the
    // threshold of 4 mm. The last of the gap closes softly: each block's planes fit the surface a
    // little differently, and a wisp that rests there would snap over some micrometres in one step.
    constexpr float kSoft = 1e-4f; // [m]
    const float gap = std::max(0.0f, plane.distance - contact.threshold);
    plane.least = dot(plane.velocity, plane.normal) - gap / step_.dt * std::min(1.0f, gap / kSoft);
    wisp_.find_row(contact.point, plane.normal, plane.row);
    plane.dragged = Four{};
    plane.impulse = 0;
    plane.pushes = false;
}

/// Whether no contact has anything to answer: none touches, and none closes in fast enough to reach
/// its plane within the step. Most blocks find planes that most of their steps do not reach.
template <int kFours> bool SlidingResponse<kFours>::idle() const {
    for (std::size_t c = 0; c < planes_.size(); ++c) {
        if (touches(c) || lacking(planes_[c]) > 0)
            return false;
    }
    return true;
}

/// Viscous drag on the skin: of a section, against the polygon where it touches (its skeleton point
/// before its envelope, then the nearest); between two sections, of the axis, where neither
/// touches. It acts on the skeleton point, which carries what an envelope point cannot (M27), and
/// once: a wisp is slowed alike by one point or by ten.
template <int kFours> void SlidingResponse<kFours>::drag() {
    find_touching();
    for (std::uint32_t i = first_; i < end_; ++i) {
        if (on_section_[i] != kNone)
            drag(on_section_[i]);
        const bool between =
            between_[i] != kNone && on_section_[i] == kNone && on_section_[i + 1] == kNone;
        if (between)
            drag(between_[i]);
    }
}

template <int kFours> void SlidingResponse<kFours>::find_touching() {
    on_section_.assign(end_ + 1, kNone);
    between_.assign(end_ + 1, kNone);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        if (!touches(c))
            continue;
        const WispPoint& point = contacts_[c].point;
        std::size_t& best = (point.along > 0 ? between_ : on_section_)[point.section];
        if (best == kNone || goes_before(c, best))
            best = c;
    }
}

template <int kFours>
bool SlidingResponse<kFours>::goes_before(std::size_t a, std::size_t b) const {
    const bool axis_a = contacts_[a].point.on_axis(), axis_b = contacts_[b].point.on_axis();
    return axis_a != axis_b ? axis_a : planes_[a].distance < planes_[b].distance;
}

template <int kFours> void SlidingResponse<kFours>::drag(std::size_t c) {
    const WispPoint point = contacts_[c].point.axis();
    Plane& plane = planes_[c];
    const Four relative = wisp_.velocity(point) - plane.velocity;
    const Four sliding = relative - plane.normal * four(dot(relative, plane.normal));
    const float speed = std::sqrt(dot(sliding, sliding));
    if (speed < kSettled)
        return;
    const Four along = sliding / four(speed);
    MotionRow<kFours> row;
    wisp_.find_row(point, along, row);
    const float inverse_mass = wisp_.weigh(row);
    if (inverse_mass <= 0)
        return;
    const float impulse = -step_.drag * speed / inverse_mass;
    plane.dragged = along * four(impulse);
    wisp_.push(row, impulse);
}

/// Few of a wisp's contacts are ever asked for an impulse: those settle among each other, and only
/// then are all looked at again.
template <int kFours> void SlidingResponse<kFours>::stop_approach() {
    pushing_.clear();
    while (find_approached())
        settle();
}

/// Takes in the contacts that are approached and do not push yet. False when there are none.
template <int kFours> bool SlidingResponse<kFours>::find_approached() {
    const std::size_t before = pushing_.size();
    for (std::uint32_t c = 0; c < planes_.size(); ++c) {
        Plane& plane = planes_[c];
        if (plane.pushes || lacking(plane) <= kSettled)
            continue;
        plane.pushes = true;
        plane.inverse_mass = wisp_.weigh(plane.row);
        pushing_.push_back(c);
    }
    return pushing_.size() > before;
}

template <int kFours> void SlidingResponse<kFours>::settle() {
    const int sweeps = pushing_.size() == 1 ? 1 : kSweeps; // alone, it is done at once
    float largest = 1;
    for (int sweep = 0; sweep < sweeps && largest > kSettled; ++sweep) {
        largest = 0;
        for (std::uint32_t c : pushing_)
            largest = std::max(largest, stop_approach(planes_[c]));
    }
}

template <int kFours> float SlidingResponse<kFours>::stop_approach(Plane& plane) {
    if (plane.inverse_mass <= 0)
        return 0;
    const float asked = plane.impulse + lacking(plane) / plane.inverse_mass;
    const float change = std::max(0.0f, asked) - plane.impulse;
    plane.impulse += change;
    wisp_.push(plane.row, change);
    return std::abs(change) * plane.inverse_mass;
}

template class SlidingResponse<1>;
template class SlidingResponse<2>;

void CharacterContacts::respond(const HairView& hair, const CharacterContactDesc& desc,
                                float fraction, float dt, State& state, Threads& threads) {
    const auto respond = hair.half_lines.size() <= 4 ? &CharacterContacts::respond_with<1>
                                                     : &CharacterContacts::respond_with<2>;
    (this->*respond)(hair,
                     {fraction, static_cast<float>(duration_), dt,
                      static_cast<float>(1 - exponential(-double(desc.friction) * double(dt))),
                      ablation_.polygon_velocity},
                     state, threads);
}

template <int kFours> void CharacterContacts::respond_with(const HairView& hair,
                                                           const SlidingStep& step, State& state,
                                                           Threads& threads) {
    const std::size_t wisps = contacts_.size();
    const std::size_t chunks = (wisps + kWispsPerChunk - 1) / kWispsPerChunk;
    auto& responses = std::get<std::vector<SlidingResponse<kFours>>>(responses_);
    responses.resize(chunks);
    impulses_.resize(wisps);
    const auto answer_chunk = [&](std::size_t chunk) {
        SlidingResponse<kFours>& response = responses[chunk];
        response.begin(hair, step);
        const std::size_t last = std::min(wisps, (chunk + 1) * kWispsPerChunk);
        for (std::size_t w = chunk * kWispsPerChunk; w < last; ++w) {
            if (!contacts_[w].empty())
                response.answer(static_cast<std::uint32_t>(w), contacts_[w], state, impulses_[w]);
        }
    };
    threads.run(chunks, std::ref(answer_chunk)); // by reference: a copy would be allocated
}

} // namespace mane
