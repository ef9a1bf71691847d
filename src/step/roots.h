#pragma once

#include "mane/body.h"
#include "mane/groom.h"
#include "model/layout.h"
#include "step/kernels.h"

#include <span>
#include <vector>

namespace mane {

/// A root's points and first axis with their velocities, in the world.
struct RootState {
    Vec3 inside, outside, axis;
    Vec3 inside_velocity, outside_velocity, axis_velocity;
};

/// Where a wisp's root is on a posed mesh: it rides its scalp triangle (M5). Positions relative to
/// the origin of `vertices`.
RootState root_state(const WispRoot& root, const Mesh& mesh, std::span<const Vec3> vertices,
                     std::span<const Vec3> velocities);

/// Roots on their way from those of another groom: `share` of it is behind them, and `rate` [1/s]
/// more per second.
struct RootChange {
    std::vector<WispRoot> from; ///< per wisp; empty: no change
    double share = 1, rate = 0;
};

/// Writes the roots of all wisps into one end (0 or 1) of the block's motion.
void follow_scalp(const Groom& groom, const Layout& layout, const Mesh& mesh,
                  std::span<const Vec3> vertices, std::span<const Vec3> velocities, int end,
                  RootMotion& motion, const RootChange& change = {});

} // namespace mane
