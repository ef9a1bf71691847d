#pragma once

/// A small head of hair that a test plays with while it moves.

#include "mane/character.h"
#include "mane/driven.h"
#include "mane/style.h"
#include "mane/world.h"

#include <cmath>
#include <memory>
#include <vector>

namespace mane {

/// Thirty wisps on the bust. Made once: laying hair takes longer than a frame of it.
struct LiveHair {
    Body bust = make_bust();
    HairDesc hair;
    std::vector<WispDesign> designs;
    Groom groom;
    SimulationDesc desc;

    static const LiveHair& get() {
        static const LiveHair hair;
        return hair;
    }
    /// The groom with another parameter of every wisp.
    template <typename Change> Groom with(Change&& change) const {
        std::vector<WispDesign> other = designs;
        for (WispDesign& wisp : other)
            change(wisp);
        return make_groom(other, bust.mesh, desc.gravity);
    }
    World world(std::shared_ptr<const Motion> motion, const RunOptions& options = {}) const {
        Body body = bust;
        body.motion = std::move(motion);
        return World(desc, groom, {body}, 0, options);
    }

  private:
    LiveHair() {
        hair.style.wisps = 30;
        hair.style.segments = 5;
        designs = lay_style(hair, bust, bust_scalp(bust));
        groom = make_groom(designs, bust.mesh);
        desc.schedule.integration_rate = 1440; // few segments, stiff springs
        desc.air.wind = {1, 0, 0.5f};
        desc.air.gusts = 0.5f;
    }
};

inline void advance(World& world, int frames) {
    for (int i = 0; i < frames; ++i)
        world.advance();
}

/// Shakes a head that is led by hand: the pose at the end of each frame.
inline HeadPose shaken(int frame) {
    const double angle = 0.5 * std::sin(0.5 * frame);
    return {bust_joints().head, {0, std::sin(angle / 2), 0, std::cos(angle / 2)}, {}};
}
inline void advance_shaken(World& world, DrivenBust& motion, int frames) {
    for (int i = 0; i < frames; ++i) {
        motion.move_to(shaken(static_cast<int>(world.frame().index) + 1), world.frame().time,
                       world.next_time());
        world.advance();
    }
}

} // namespace mane
