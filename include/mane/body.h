#pragma once

#include "mane/vec.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mane {

/// A closed surface made of triangles, counter-clockwise seen from outside.
struct Mesh {
    std::vector<Vec3> vertices;                          ///< [m], in the rest pose
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< indices into `vertices`
};

/// Linear blend skinning: every vertex follows up to four bones.
struct Skin {
    static constexpr int kInfluences = 4;
    std::vector<std::array<std::uint16_t, kInfluences>>
        bones;                                           ///< per vertex; empty: all follow bone 0
    std::vector<std::array<float, kInfluences>> weights; ///< per vertex, sum 1
};

/// Where a bone has taken the rest pose: a rest point p is at `rotation.rotate(p) + position`.
struct BonePose {
    Vec3d position;         ///< [m]
    Quatd rotation;         ///< unit
    Vec3d velocity;         ///< [m/s], of `position`
    Vec3d angular_velocity; ///< [rad/s], world axes

    bool operator==(const BonePose&) const = default;
};

/// Prescribed motion of a body's bones, defined and C² at every time (§4.2, M29).
class Motion {
  public:
    virtual ~Motion() = default;
    virtual std::size_t bone_count() const = 0;
    /// Fills `bones` (size `bone_count()`) with the poses at `time` [s]. Safe to call from several
    /// threads.
    virtual void evaluate(double time, std::span<BonePose> bones) const = 0;
};

/// The character, or an obstacle: a mesh that moves and deforms. The first body of a world wears
/// the hair.
struct Body {
    std::string name;
    Mesh mesh;
    Skin skin;
    std::shared_ptr<const Motion> motion; ///< null: the body stays in its rest pose
    std::uint32_t head_bone = 0;          ///< the bone that the simulation's origin follows
    bool worn = false;                    ///< a hat: wisps may start inside it
};

} // namespace mane
