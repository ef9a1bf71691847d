#pragma once

#include "interactions/character_point.h"

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

/// The answers of one wisp's contacts: a plastic impact of all of them together. Contact after
/// contact, from root to tip, takes the impulse that its closing velocity asks for, given the
/// velocities that the others left; what it gave before may be taken back, but its sum stays a
/// push. Each such change lowers ½ JᵀWJ + J·v, the energy that the impulses J add in the polygons'
/// frame, so energy never rises, whatever the masses and wherever the sweeps end; they converge to
/// the one velocity nearest to the old one, in the masses' measure, that no plane forbids.
/// (Impulses never taken back end elsewhere: a heavy envelope makes its skeleton bounce. Contacts
/// answered all at once with shared masses keep a part of the approach, and a wisp at rest creeps
/// inward.)
///
/// Wisps are answered one after the other by the same object: what it holds is scratch, so that a
/// step allocates nothing.
class SlidingResponse {
  public:
    /// The step within the block.
    struct Step {
        float fraction; ///< of the block that has passed
        float duration; ///< [s] of the block
        float dt;       ///< [s] of the step
        float drag;     ///< the share of the sliding velocity that is lost in the step
        bool polygons_move = true;
    };

    /// Answers the contacts (not none, sorted by section) of wisp `number` of `hair`, which views
    /// `state`. `impulses`: what each did [N·s].
    void answer(const HairView& hair, std::uint32_t number,
                std::span<const SlidingContact> contacts, const Step& step, State& state,
                std::vector<Vec3>& impulses);

  private:
    static bool far_off(const HairView& hair, Slot root, const SlidingContact& contact,
                        const Step& step);

    /// A contact's plane now.
    struct Plane {
        Vec3 normal;
        Vec3 velocity;           // of the polygon at the point's foot
        float distance = 0;      // of the point
        float least_closing = 0; // the velocity along the normal may not be under this
        float inverse_mass = 0;  // that an impulse along the normal meets, once it is asked for
        bool weighed = false;    // whether it was
        float impulse = 0;       // given so far in this step, along the normal
        Vec3 dragged;            // the impulse of drag
    };

    Plane plane_now(const SlidingContact& contact, const Step& step) const;
    void find_planes(const Step& step);
    bool idle() const;
    float closing(std::size_t c) const;
    void find_touching();
    bool goes_before(std::size_t a, std::size_t b) const;
    void drag(float loss);
    void drag(std::size_t c, float loss);
    void stop_approach();
    float stop_approach(std::size_t c);

    WispCopy wisp_;
    std::span<const SlidingContact> contacts_;
    std::uint32_t first_ = 0, end_ = 0; // the sections that the contacts are on
    std::vector<Plane> planes_;
    /// The contact that drags each section, and each segment between two sections.
    std::vector<std::size_t> on_section_, between_;
};

} // namespace mane
