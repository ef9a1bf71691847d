#include "base/functions.h"
#include "interactions/character_contact.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr std::size_t kWispsPerChunk = 64;
/// A wisp's contacts are gone through until no impulse changes a velocity by more than this [m/s],
/// far under what shows.
constexpr float kSettled = 1e-6f;
/// At most so many times: a section held by several planes settles by about half each time.
constexpr int kSweeps = 24;

/// A contact's plane now.
struct Plane {
    Vec3 normal;
    Vec3 velocity;           // of the polygon at the point's foot
    float distance = 0;      // of the point
    float least_closing = 0; // the velocity along the normal may not be under this
    float inverse_mass = 0;  // that an impulse along the normal meets
    float impulse = 0;       // given so far in this step, along the normal
};

Plane plane_now(const SlidingContact& contact, const Vec3& point, float fraction, float duration,
                float dt) {
    const Vec3 way = contact.normal + contact.normal_change * fraction;
    const float size = length(way);
    Plane plane;
    plane.normal = way / size;
    const Vec3 from_anchor = point - (contact.anchor + contact.anchor_change * fraction);
    plane.distance = dot(from_anchor, plane.normal);
    // The plane moves with its anchor and turns: d/dt (p − a)·n = (v − ȧ)·n + (p − a)·ṅ with ṅ
    // across n.
    const Vec3 turn =
        contact.normal_change - plane.normal * dot(contact.normal_change, plane.normal);
    const float turning = dot(from_anchor, turn) / (size * duration);
    plane.velocity = contact.anchor_change / duration - plane.normal * turning;
    // Nothing may pass the threshold within a step, ours: at 5 m/s a step of 1 ms is wider than the
    // threshold of 4 mm. The last of the gap closes softly: each block's planes fit the surface a
    // little differently, and a wisp that rests there would snap over some micrometres in one step.
    constexpr float kSoft = 1e-4f; // [m]
    const float gap = std::max(0.0f, plane.distance - contact.threshold);
    plane.least_closing = -gap / dt * std::min(1.0f, gap / kSoft);
    return plane;
}

/// The answers of one wisp's contacts: a plastic impact of all of them together. Contact after
/// contact, from root to tip, takes the impulse that its closing velocity asks for, given the
/// velocities that the others left; what it gave before may be taken back, but its sum stays a
/// push. Each such change lowers ½ JᵀWJ + J·v, the energy that the impulses J add in the polygons'
/// frame, so energy never rises, whatever the masses and wherever the sweeps end; they converge to
/// the one velocity nearest to the old one, in the masses' measure, that no plane forbids.
/// (Impulses never taken back end elsewhere: a heavy envelope makes its skeleton bounce. Contacts
/// answered all at once with shared masses keep a part of the approach, and a wisp at rest creeps
/// inward.)
class Responder {
  public:
    Responder(WispCopy& wisp, std::span<const SlidingContact> contacts, float fraction,
              float duration, float dt, const Ablation& ablation)
        : wisp_(wisp), contacts_(contacts) {
        for (const SlidingContact& contact : contacts) {
            Plane plane = plane_now(contact, wisp.position(contact.point), fraction, duration, dt);
            plane.inverse_mass = wisp.inverse_mass(contact.point, plane.normal);
            if (!ablation.polygon_velocity)
                plane.velocity = {};
            planes_.push_back(plane);
        }
    }

    /// Viscous drag on the skin: of a section, against the polygon where it touches (its skeleton
    /// point before its envelope, then the nearest); between two sections, of the axis, where
    /// neither touches. It acts on the skeleton point, which carries what an envelope point cannot
    /// (M27), and once: a wisp is slowed alike by one point or by ten.
    void drag(float loss) {
        const auto touching = find_touching();
        for (std::uint32_t i = 0; i < wisp_.sections(); ++i) {
            if (touching.section[i] != kNone)
                drag(touching.section[i], loss);
            const bool between = touching.between[i] != kNone && touching.section[i] == kNone &&
                                 touching.section[i + 1] == kNone;
            if (between)
                drag(touching.between[i], loss);
        }
    }

    void stop_approach() {
        float largest = 1;
        for (int sweep = 0; sweep < kSweeps && largest > kSettled; ++sweep) {
            largest = 0;
            for (std::size_t c = 0; c < contacts_.size(); ++c)
                largest = std::max(largest, stop_approach(contacts_[c], planes_[c]));
        }
    }

  private:
    static constexpr std::size_t kNone = ~std::size_t{0};
    /// The contact that drags each section, and each segment between two sections.
    struct Touching {
        std::vector<std::size_t> section, between;
    };

    Touching find_touching() const {
        Touching touching{std::vector(wisp_.sections(), kNone),
                          std::vector(wisp_.sections(), kNone)};
        for (std::size_t c = 0; c < contacts_.size(); ++c) {
            const WispPoint& point = contacts_[c].point;
            if (planes_[c].distance >= contacts_[c].threshold)
                continue;
            std::size_t& best =
                (point.along > 0 ? touching.between : touching.section)[point.section];
            if (best == kNone || goes_before(c, best))
                best = c;
        }
        return touching;
    }

    bool goes_before(std::size_t a, std::size_t b) const {
        const bool axis_a = contacts_[a].point.on_axis(), axis_b = contacts_[b].point.on_axis();
        return axis_a != axis_b ? axis_a : planes_[a].distance < planes_[b].distance;
    }

    void drag(std::size_t c, float loss) {
        const WispPoint point = contacts_[c].point.axis();
        const Plane& plane = planes_[c];
        const Vec3 relative = wisp_.velocity(point) - plane.velocity;
        const Vec3 sliding = relative - plane.normal * dot(relative, plane.normal);
        const float speed = length(sliding);
        if (speed < kSettled)
            return;
        const Vec3 along = sliding / speed;
        const float inverse_mass = wisp_.inverse_mass(point, along);
        if (inverse_mass > 0)
            wisp_.push(point, along * (-loss * speed / inverse_mass));
    }

    float stop_approach(const SlidingContact& contact, Plane& plane) {
        if (plane.inverse_mass == 0)
            return 0;
        const float closing = dot(wisp_.velocity(contact.point) - plane.velocity, plane.normal);
        const float asked = plane.impulse + (plane.least_closing - closing) / plane.inverse_mass;
        const float change = std::max(0.0f, asked) - plane.impulse;
        if (change == 0)
            return 0;
        plane.impulse += change;
        wisp_.push(contact.point, plane.normal * change);
        return std::abs(change) * plane.inverse_mass;
    }

    WispCopy& wisp_;
    std::span<const SlidingContact> contacts_;
    std::vector<Plane> planes_;
};

} // namespace

void CharacterContacts::respond(const HairView& hair, const CharacterContactDesc& desc,
                                float fraction, float dt, State& state, Threads& threads) const {
    const std::size_t wisps = contacts_.size();
    const auto loss = static_cast<float>(1 - exponential(-double(desc.friction) * double(dt)));
    threads.run((wisps + kWispsPerChunk - 1) / kWispsPerChunk, [&](std::size_t chunk) {
        WispCopy wisp;
        const std::size_t last = std::min(wisps, (chunk + 1) * kWispsPerChunk);
        for (std::size_t i = chunk * kWispsPerChunk; i < last; ++i) {
            if (contacts_[i].empty())
                continue;
            const auto w = static_cast<std::uint32_t>(i);
            // sorted by section; a point may be between its section and the next
            const std::uint32_t end = contacts_[i].back().point.section + 2;
            wisp.load(hair, w, contacts_[i].front().point.section,
                      std::min(end, hair.groom.sections(w)));
            Responder responder(wisp, contacts_[i], fraction, static_cast<float>(duration_), dt,
                                ablation_);
            responder.drag(loss);
            responder.stop_approach();
            wisp.store_velocities(hair, state);
        }
    });
}

} // namespace mane
