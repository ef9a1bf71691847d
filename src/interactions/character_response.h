#pragma once

#include "interactions/character_motion.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// A sliding contact (§4.2, M30, M36): a plane that moves with its polygon over the block, linearly
/// from start to end.
struct SlidingContact {
    WispPoint point;
    std::uint32_t body = 0;
    std::uint32_t triangle = 0;
    Vec3 anchor;         ///< [m] a point of the polygon, at the block's start
    Vec3 anchor_change;  ///< [m] over the block
    Vec3 normal;         ///< unit, away from the body, at the block's start
    Vec3 normal_change;  ///< over the block
    float threshold = 0; ///< [m] distance under which it answers

    bool operator==(const SlidingContact&) const = default;
};

/// A step within the block.
struct SlidingStep {
    float fraction; ///< of the block that has passed
    float duration; ///< [s] of the block
    float dt;       ///< [s] of the step
    float drag;     ///< the share of the sliding velocity that is lost in the step
    bool polygons_move = true;
};

/// The answers of one wisp's contacts: a plastic impact of all of them together. Contact after
/// contact takes the impulse that its closing velocity asks for, given the velocities that the
/// others left; what it gave before may be taken back, but its sum stays a push. Each such change
/// lowers ½ JᵀWJ + J·v, the energy that the impulses J add in the polygons' frame, so energy never
/// rises, whatever the masses and wherever the sweeps end; they converge to the one velocity
/// nearest to the old one, in the masses' measure, that no plane forbids. (Impulses never taken
/// back end elsewhere: a heavy envelope makes its skeleton bounce. Contacts answered all at once
/// with shared masses keep a part of the approach, and a wisp at rest creeps inward.)
///
/// Wisps are answered one after the other by the same object: what it holds is scratch, so that a
/// step allocates nothing.
template <int kFours> class SlidingResponse {
  public:
    /// The hair whose wisps are answered, at a step.
    void begin(const HairView& hair, const SlidingStep& step);
    /// Answers the contacts (not none, sorted by section) of wisp `number`. `state` is what the
    /// hair views. `impulses`: what each did [N·s].
    void answer(std::uint32_t number, std::span<const SlidingContact> contacts, State& state,
                std::vector<Vec3>& impulses);

  private:
    /// A contact's plane now.
    struct Plane {
        Four normal;
        Four velocity;         // of the polygon at the point's foot
        Four dragged;          // the impulse of drag
        MotionRow<kFours> row; // of the point along the normal
        float distance;        // of the point
        float least;           // the velocity of the point along the normal may not be under this
        float impulse;         // given so far in this step, along the normal
        float inverse_mass;    // that it meets, of those that push
        bool pushes;           // whether it was asked for an impulse
    };

    void load(std::uint32_t number);
    void find_planes();
    void find_plane(const SlidingContact& contact, Plane& plane) const;
    float lacking(const Plane& plane) const { return plane.least - wisp_.along(plane.row); }
    bool touches(std::size_t c) const { return planes_[c].distance < contacts_[c].threshold; }
    bool idle() const;
    void find_touching();
    bool goes_before(std::size_t a, std::size_t b) const;
    void drag();
    void drag(std::size_t c);
    void stop_approach();
    bool find_approached();
    void settle();
    float stop_approach(Plane& plane);

    SlidingStep step_{};
    WispMotion<kFours> wisp_;
    std::span<const SlidingContact> contacts_;
    std::uint32_t first_ = 0, end_ = 0; // the sections that the contacts are on
    std::vector<Plane> planes_;
    std::vector<std::uint32_t> pushing_; // the contacts that were asked for an impulse
    /// The contact that drags each section, and each segment between two sections.
    std::vector<std::size_t> on_section_, between_;
};

} // namespace mane
