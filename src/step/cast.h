#pragma once

#include "character/surface.h"
#include "interactions/character_contact.h"
#include "mane/body.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mane {

/// All bodies of a world in motion: their posed vertices, and their surfaces over the present
/// detection block.
class Cast {
  public:
    /// `instruction_set`: of the searches on their surfaces; "" for the machine's best.
    explicit Cast(std::vector<Body> bodies, const std::string& instruction_set = "");

    /// Poses every body at `time` [s], relative to `origin`: at the beginning of a frame, when the
    /// origin has moved.
    void begin(double time, const Vec3d& origin);
    /// Poses every body at the end of a block that is over at `time`, `seconds` after it began.
    void advance(double time, double seconds, const Vec3d& origin);

    std::size_t count() const { return bodies_.size(); }
    const Body& body(std::size_t b) const { return bodies_[b]; }
    const std::vector<Vec3>& vertices(std::size_t b) const { return posed_[b].vertices; }
    const std::vector<Vec3>& velocities(std::size_t b) const { return posed_[b].velocities; }
    /// The bodies as contact sees them; valid as long as this lives.
    std::vector<ContactBody> contact_bodies() const;
    std::vector<std::string> names() const;

    std::size_t bones(std::size_t b) const;
    /// A bone of body `b` at `time`.
    BonePose bone(std::size_t b, std::uint32_t bone, double time) const {
        return bones_at(b, time)[bone];
    }
    /// The first body's head at `time`.
    BonePose head(double time) const { return bone(0, bodies_[0].head_bone, time); }
    /// World position [m] at `time` of a point fixed to the first body's head, given in its rest
    /// pose.
    Vec3d on_head(const Vec3d& rest, double time) const;
    /// World position [m] at `time` of a point of the first body's rest pose that moves as its
    /// vertex `vertex` does.
    Vec3d carried_like(std::size_t vertex, const Vec3d& rest, double time) const;

  private:
    struct Posed {
        std::vector<Vec3> vertices, velocities;
        std::vector<std::uint32_t> main_bones; ///< those that most of the body follows
        std::vector<RigidFrame> frames;        ///< where they are
    };
    std::span<const BonePose> bones_at(std::size_t b, double time) const;
    void pose(std::size_t b, double time, const Vec3d& origin);

    std::vector<Body> bodies_;
    std::vector<Posed> posed_;
    std::vector<std::unique_ptr<Surface>> surfaces_;
    mutable std::vector<BonePose> bones_; ///< scratch
};

} // namespace mane
