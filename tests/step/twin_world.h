#pragma once

/// A World whose hair is the twin's: the same bodies, roots and schedule, but every force, answer
/// and position in plain double. What touches what is found by the core, on the twin's own state:
/// the lists are compared with brute force elsewhere.

#include "mane/world.h"
#include "reference/hair_step.h"
#include "step/cast.h"
#include "step/step.h"

#include <cstdint>
#include <vector>

namespace mane {

class TwinWorld {
  public:
    /// As World's; the origin stays where the head was at the start.
    TwinWorld(const SimulationDesc& desc, const Groom& groom, std::vector<Body> bodies);

    void advance();
    const reference::Hair& hair() const { return hair_; }
    Vec3d origin() const { return core_.origin; }
    const Statistics& statistics() const { return core_.statistics; }
    /// [s] that the twin's own steps took: forces, answers and positions, without what the core
    /// finds for it.
    double step_seconds() const { return step_seconds_; }

  private:
    void enter_block(double time, double seconds);
    void detect(bool wisps);
    void step(const StepPlace& place, double time);
    void react();

    void write_state();
    std::vector<reference::Root> roots_at(float s);
    std::vector<Vec3d> air_at(double time) const;

    Simulation core_; ///< its state is a copy of the twin's, in float
    Cast cast_;
    reference::Hair hair_;
    std::vector<reference::Contact> contacts_;
    std::uint64_t frames_ = 0;
    double step_seconds_ = 0;
};

} // namespace mane
