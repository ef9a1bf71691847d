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

void SlidingResponse::answer(const HairView& hair, std::uint32_t number,
                             std::span<const SlidingContact> contacts, const Step& step,
                             State& state, std::vector<Vec3>& impulses) {
    const Slot root = hair.layout.slot(hair.groom.first_section[number]);
    impulses.assign(contacts.size(), {});
    if (std::all_of(contacts.begin(), contacts.end(),
                    [&](const auto& contact) { return far_off(hair, root, contact, step); }))
        return;
    contacts_ = contacts;
    first_ = contacts.front().point.section;
    end_ = first_ + 1;
    for (const SlidingContact& contact : contacts)
        end_ = std::max(end_, contact.point.section + (contact.point.along > 0 ? 2 : 1));
    wisp_.load_motion(hair, number, first_, end_);
    find_planes(step);
    if (idle())
        return;
    wisp_.load_masses(hair);
    drag(step.drag);
    stop_approach();
    wisp_.store_velocities(hair, state);
    for (std::size_t c = 0; c < planes_.size(); ++c)
        impulses[c] = planes_[c].normal * planes_[c].impulse + planes_[c].dragged;
}

namespace {

/// A point of a wisp, straight from the state.
struct PointNow {
    Vec3 position, velocity;
};
PointNow point_of_section(const HairView& hair, Slot slot, const WispPoint& point) {
    PointNow now{hair.state.position.vec(slot), hair.state.velocity.vec(slot)};
    if (point.on_axis())
        return now;
    const Vec3 u = hair.frames.u.vec(slot), v = hair.frames.v.vec(slot);
    const auto add = [&](std::uint32_t line, float share) {
        const HalfLine& d = hair.half_lines[line];
        const Vec3 way = (u * d.cosine + v * d.sine) * share;
        now.position += way * hair.state.radius.at(slot, line);
        now.velocity += way * hair.state.radius_rate.at(slot, line);
    };
    add(point.k, point.alpha);
    if (point.beta > 0)
        add(point.k + 1 == hair.half_lines.size() ? 0 : point.k + 1, point.beta);
    return now;
}
PointNow point_now(const HairView& hair, Slot root, const WispPoint& point) {
    const Slot slot{root.row + point.section, root.lane};
    const PointNow here = point_of_section(hair, slot, point);
    if (point.along == 0)
        return here;
    const PointNow after = point_of_section(hair, {slot.row + 1, slot.lane}, point);
    return {here.position * (1 - point.along) + after.position * point.along,
            here.velocity * (1 - point.along) + after.velocity * point.along};
}

/// Not under the length, without a root.
float at_least_length(const Vec3& v) {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

} // namespace

/// Whether a contact has nothing to answer even if its point came straight at its plane: most
/// planes, in most steps. The point is over the plane by at least its height along the normal,
/// which is no longer than one between the block's ends. May fail to tell.
bool SlidingResponse::far_off(const HairView& hair, Slot root, const SlidingContact& contact,
                              const Step& step) {
    constexpr float kOverRounding = 1e-5f; // [m]
    constexpr float kSoftest = 2e-4f;      // [m] over where a gap closes softly
    const PointNow point = point_now(hair, root, contact.point);
    const Vec3 way = contact.normal + contact.normal_change * step.fraction;
    const Vec3 from_anchor =
        point.position - (contact.anchor + contact.anchor_change * step.fraction);
    const float gap = dot(from_anchor, way) - contact.threshold - kOverRounding;
    if (gap < kSoftest || dot(way, way) < 0.25f)
        return false;
    // |ṅ| is at most twice the change of what is not quite unit
    const float closes = at_least_length(point.velocity) * step.duration +
                         at_least_length(contact.anchor_change) +
                         2 * at_least_length(from_anchor) * at_least_length(contact.normal_change);
    return closes * step.dt < gap * step.duration;
}

void SlidingResponse::find_planes(const Step& step) {
    planes_.clear();
    for (const SlidingContact& contact : contacts_)
        planes_.push_back(plane_now(contact, step));
}

SlidingResponse::Plane SlidingResponse::plane_now(const SlidingContact& contact,
                                                  const Step& step) const {
    const Vec3 way = contact.normal + contact.normal_change * step.fraction;
    const float size = length(way);
    Plane plane;
    plane.normal = way / size;
    const Vec3 from_anchor =
        wisp_.position(contact.point) - (contact.anchor + contact.anchor_change * step.fraction);
    plane.distance = dot(from_anchor, plane.normal);
    // The plane moves with its anchor and turns: d/dt (p − a)·n = (v − ȧ)·n + (p − a)·ṅ with ṅ
    // across n.
    const Vec3 turn =
        contact.normal_change - plane.normal * dot(contact.normal_change, plane.normal);
    const float turning = dot(from_anchor, turn) / (size * step.duration);
    plane.velocity = contact.anchor_change / step.duration - plane.normal * turning;
    // Nothing may pass the threshold within a step, ours: at 5 m/s a step of 1 ms is wider than the
    // threshold of 4 mm. The last of the gap closes softly: each block's planes fit the surface a
    // little differently, and a wisp that rests there would snap over some micrometres in one step.
    constexpr float kSoft = 1e-4f; // [m]
    const float gap = std::max(0.0f, plane.distance - contact.threshold);
    plane.least_closing = -gap / step.dt * std::min(1.0f, gap / kSoft);
    if (!step.polygons_move)
        plane.velocity = {};
    return plane;
}

float SlidingResponse::closing(std::size_t c) const {
    const Plane& plane = planes_[c];
    return dot(wisp_.velocity(contacts_[c].point) - plane.velocity, plane.normal);
}

/// Whether no contact has anything to answer: none touches, and none closes in fast enough to reach
/// its plane within the step. Most blocks find planes that most of their steps do not reach.
bool SlidingResponse::idle() const {
    for (std::size_t c = 0; c < planes_.size(); ++c) {
        if (planes_[c].distance < contacts_[c].threshold || closing(c) < planes_[c].least_closing)
            return false;
    }
    return true;
}

/// Viscous drag on the skin: of a section, against the polygon where it touches (its skeleton point
/// before its envelope, then the nearest); between two sections, of the axis, where neither
/// touches. It acts on the skeleton point, which carries what an envelope point cannot (M27), and
/// once: a wisp is slowed alike by one point or by ten.
void SlidingResponse::drag(float loss) {
    find_touching();
    for (std::uint32_t i = first_; i < end_; ++i) {
        if (on_section_[i] != kNone)
            drag(on_section_[i], loss);
        const bool between =
            between_[i] != kNone && on_section_[i] == kNone && on_section_[i + 1] == kNone;
        if (between)
            drag(between_[i], loss);
    }
}

void SlidingResponse::find_touching() {
    on_section_.assign(end_ + 1, kNone);
    between_.assign(end_ + 1, kNone);
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
        const WispPoint& point = contacts_[c].point;
        if (planes_[c].distance >= contacts_[c].threshold)
            continue;
        std::size_t& best = (point.along > 0 ? between_ : on_section_)[point.section];
        if (best == kNone || goes_before(c, best))
            best = c;
    }
}

bool SlidingResponse::goes_before(std::size_t a, std::size_t b) const {
    const bool axis_a = contacts_[a].point.on_axis(), axis_b = contacts_[b].point.on_axis();
    return axis_a != axis_b ? axis_a : planes_[a].distance < planes_[b].distance;
}

void SlidingResponse::drag(std::size_t c, float loss) {
    const WispPoint point = contacts_[c].point.axis();
    Plane& plane = planes_[c];
    const Vec3 relative = wisp_.velocity(point) - plane.velocity;
    const Vec3 sliding = relative - plane.normal * dot(relative, plane.normal);
    const float speed = length(sliding);
    if (speed < kSettled)
        return;
    const Vec3 along = sliding / speed;
    const float inverse_mass = wisp_.inverse_mass(point, along);
    if (inverse_mass == 0)
        return;
    plane.dragged = along * (-loss * speed / inverse_mass);
    wisp_.push(point, plane.dragged);
}

void SlidingResponse::stop_approach() {
    float largest = 1;
    for (int sweep = 0; sweep < kSweeps && largest > kSettled; ++sweep) {
        largest = 0;
        for (std::size_t c = 0; c < contacts_.size(); ++c)
            largest = std::max(largest, stop_approach(c));
    }
}

float SlidingResponse::stop_approach(std::size_t c) {
    const SlidingContact& contact = contacts_[c];
    Plane& plane = planes_[c];
    const float lacking = plane.least_closing - closing(c);
    if (lacking <= 0 && plane.impulse == 0)
        return 0;
    if (!plane.weighed) {
        plane.inverse_mass = wisp_.inverse_mass(contact.point, plane.normal);
        plane.weighed = true;
    }
    if (plane.inverse_mass == 0)
        return 0;
    const float asked = plane.impulse + lacking / plane.inverse_mass;
    const float change = std::max(0.0f, asked) - plane.impulse;
    if (change == 0)
        return 0;
    plane.impulse += change;
    wisp_.push(contact.point, plane.normal * change);
    return std::abs(change) * plane.inverse_mass;
}

void CharacterContacts::respond(const HairView& hair, const CharacterContactDesc& desc,
                                float fraction, float dt, State& state, Threads& threads) {
    const std::size_t wisps = contacts_.size();
    const std::size_t chunks = (wisps + kWispsPerChunk - 1) / kWispsPerChunk;
    const SlidingResponse::Step step{
        fraction, static_cast<float>(duration_), dt,
        static_cast<float>(1 - exponential(-double(desc.friction) * double(dt))),
        ablation_.polygon_velocity};
    responses_.resize(chunks);
    impulses_.resize(wisps);
    const auto answer_chunk = [&](std::size_t chunk) {
        const std::size_t last = std::min(wisps, (chunk + 1) * kWispsPerChunk);
        for (std::size_t w = chunk * kWispsPerChunk; w < last; ++w) {
            if (!contacts_[w].empty())
                responses_[chunk].answer(hair, static_cast<std::uint32_t>(w), contacts_[w], step,
                                         state, impulses_[w]);
        }
    };
    threads.run(chunks, std::ref(answer_chunk)); // by reference: a copy would be allocated
}

} // namespace mane
