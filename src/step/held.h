#pragma once

#include "step/kernels.h"

#include <vector>

namespace mane {

/// Sections that are led by hand while the rest of the hair is simulated (M46): pinned ones, whose
/// skeleton point has no say in where it is, and the radii of the two sections on the head while
/// they change to another groom's. Their inverse masses in the rest rows are 0, so that all else
/// answers to them and they to nothing; here is where they go.
class Held {
  public:
    /// A skeleton point over the present block, as roots go: a cubic Hermite curve.
    struct Point {
        Slot slot;
        Vec3 value[2], slope[2]; ///< [m] at the block's ends, and by its time from 0 to 1
        Vec3 before;             ///< [m/s] its velocity before the forces of this step
    };
    /// A radius of a section on the head, likewise.
    struct Radius {
        Slot slot;
        std::uint32_t k = 0;
        float from = 0, to = 0; ///< [m] over the frame
        float value[2] = {}, slope[2] = {};
    };

    bool empty() const { return points.empty() && radii.empty(); }
    /// Leads the radii over the part of the frame from `begin` to `end`, 0 to 1.
    void lead_radii(double begin, double end);

    // In a step, in this order.
    void note_velocities(const State& state);
    /// A held section's envelope feels how it is moved, and gravity and air, as that of a free one
    /// feels the springs (docs/model.md, "Coupling").
    void accelerate_envelopes(const KernelData& data, float s) const;
    void move(State& state, float s, float block_seconds) const;
    void place(State& state, float s) const;

    std::vector<Point> points;
    std::vector<Radius> radii;
};

} // namespace mane
