#pragma once

#include "base/parallel_for.h"
#include "interactions/contact_points.h"

#include <string>

namespace mane {

/// Keeps the points of the hair that can be in contact where they are now.
class ContactGeometry {
  public:
    /// `instruction_set`: "" for the machine's best.
    explicit ContactGeometry(const std::string& instruction_set = "");

    /// Takes places, directions and velocities of now: at the beginning of a detection block.
    void take(const HairView& hair, Threads& threads);
    /// Takes velocities of now: at every step.
    void take_velocities(const HairView& hair, Threads& threads);
    /// Adds a change to the velocities and radius rates of the hair.
    void add_to(State& state, const Layout& layout, const SectionMotion& change,
                Threads& threads) const;

    /// The design has these radii now; the order in memory stays.
    void change_design(const Groom& groom);

    const ContactPoints& points() const { return points_; }
    /// Makes room for the velocities of more points, behind all others.
    void add_points(std::size_t count) { points_.velocity.resize(points_.places() + count); }
    Four* velocities() { return points_.velocity.data(); }

  private:
    ContactPoints points_;
    ContactPointKernels kernels_;
};

} // namespace mane
