#pragma once

#include "mane/body.h"

#include <span>
#include <vector>

namespace mane {

/// All bodies of a world in motion: their vertices and velocities at one time, relative to the
/// world's origin.
class Cast {
  public:
    explicit Cast(std::vector<Body> bodies);

    /// Poses every body at `time` [s], relative to `origin`.
    void pose(double time, const Vec3d& origin);

    std::size_t count() const { return bodies_.size(); }
    const Body& body(std::size_t b) const { return bodies_[b]; }
    const std::vector<Vec3>& vertices(std::size_t b) const { return posed_[b].vertices; }
    const std::vector<Vec3>& velocities(std::size_t b) const { return posed_[b].velocities; }

    /// World position [m] at `time` of a point fixed to the first body's head, given in its rest
    /// pose.
    Vec3d on_head(const Vec3d& rest, double time) const;
    /// Skinning of a point of the first body's rest pose, as if it were its vertex `vertex`, at
    /// `time`.
    Vec3d carried_like(std::size_t vertex, const Vec3d& rest, double time) const;

  private:
    struct Posed {
        std::vector<Vec3> vertices, velocities;
    };
    std::span<const BonePose> bones_at(std::size_t b, double time) const;
    void pose_body(std::size_t b, double time, const Vec3d& origin, Posed& out) const;

    std::vector<Body> bodies_;
    std::vector<Posed> posed_;
    mutable std::vector<BonePose> bones_; // scratch
};

} // namespace mane
