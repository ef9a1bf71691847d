#pragma once

#include "base/parallel_for.h"
#include "character/surface.h"
#include "interactions/character_contact.h"
#include "mane/groom.h"
#include "model/state.h"

#include <functional>
#include <memory>
#include <vector>

namespace mane::test {

/// Hair without a solver: wisps made of points given by hand, to be touched by bodies.
struct ToyHair {
    Groom groom;
    std::unique_ptr<Layout> layout;
    RestRows rest;
    std::vector<HalfLine> lines;
    State state;
    SectionFrames frames;
    float turn = 0; ///< [rad] of the first axis about each wisp

    /// `wisps`: the skeleton points of each, from x₀. Every section has K = `k` envelope points at
    /// `radius`.
    ToyHair(const std::vector<std::vector<Vec3>>& wisps, std::uint32_t k, float radius);
    /// A straight wisp of `sections` points from `first`, each `step` from the one before.
    static std::vector<Vec3> straight(const Vec3& first, const Vec3& step, int sections);

    HairView view() const { return {groom, *layout, rest, state, frames, lines}; }
    Slot slot(std::uint32_t wisp, std::uint32_t section) const {
        return layout->slot(groom.first_section[wisp] + section);
    }
    Vec3 x(std::uint32_t wisp, std::uint32_t section) const {
        return state.position.vec(slot(wisp, section));
    }
    Vec3 v(std::uint32_t wisp, std::uint32_t section) const {
        return state.velocity.vec(slot(wisp, section));
    }
    /// Sections' frames of the present curve (M7, M8), written plainly.
    void find_frames();
    /// Kinetic energy of the simulated sections relative to a frame moving at `frame` [J]
    /// (docs/model.md).
    double energy(const Vec3& frame) const;
};

/// A run of the blocks and steps of one or more rigid bodies and a ToyHair, with gravity and, if
/// asked, radial springs.
struct ToyRun {
    ToyHair& hair;
    std::vector<Mesh> rest;
    std::vector<std::unique_ptr<Surface>> surfaces;
    std::vector<bool> worn;
    std::vector<Mesh> now;
    CharacterContactDesc desc;
    CharacterContacts contacts;
    Vec3 gravity{0, -9.81f, 0};
    float air = 0;     ///< [1/s] drag in still air
    float stretch = 0; ///< [1/s²] stiffness over mass of springs between neighbouring sections,
                       ///< critically damped
    float spring = 0;  ///< [N/m] radial springs toward `spring_length`
    float spring_length = 0; ///< [m]
    float rest_length = 0;   ///< [m] of `stretch`
    int steps_per_block = 8;
    float dt = 0.001f;
    double time = 0;
    std::uint64_t reactions = 0;
    Threads threads;

    ToyRun(ToyHair& hair_, std::vector<Mesh> bodies, unsigned thread_count = 1);
    /// One block: `place(body, time, rest vertex)` says where the bodies are.
    using Place = std::function<Vec3d(std::size_t body, double time, const Vec3d& rest)>;
    void block(const Place& place);
    std::vector<ContactBody> bodies() const;

  private:
    void step(float fraction);
    template <int kFours> void spring_forces();
    void move();
    void react();
};

} // namespace mane::test
