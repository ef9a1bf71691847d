#pragma once

#include "mane/body.h"
#include "mane/character.h"

#include <memory>
#include <span>
#include <vector>

namespace mane {

/// A place: a rest point p is at `rotation.rotate(p) + position`.
struct Pose {
    Vec3d position; ///< [m]
    Quatd rotation; ///< any length but zero
    bool operator==(const Pose&) const = default;
};

/// Where a head is. The neck is turned halfway between chest and head, and all hang from the head
/// by the bust's proportions, as in a clip.
struct HeadPose {
    Vec3d position; ///< [m] of the head's joint, where the skull sits on the neck
    Quatd rotation; ///< of the head, any length but zero
    Quatd chest;    ///< of the shoulders, any length but zero
    bool operator==(const HeadPose&) const = default;
};

// A host leads these motions while a world runs: before each `advance` it says where a body is to
// be at that frame's end, and there it is, exactly. Between two frames the way is a quintic, C²
// over all frames, however jerky the poses: a frame ends at the mean velocity of its own way and
// without acceleration, so a steady way stays steady, and no acceleration is over four times the
// second difference of the poses by the square of the frame's length. A host that stops leading
// leaves the body where it led it last; it comes to rest there within a frame of the same length.
//
//     motion->move_to(pose, world.frame().time, world.next_time());
//     world.advance();
//
// Not to be called while the world that holds the motion advances. All throw InputError, and then
// change nothing, for a pose that is not finite, a rotation of length zero, or a `to` [s] that is
// not after `from`.

/// Rigid bones led by a host, each on its own.
class DrivenMotion final : public Motion {
  public:
    struct Bone {
        Pose begin;  ///< where it rests until it is led
        Vec3d pivot; ///< [m] in the rest pose: the point that goes the smooth way
    };
    explicit DrivenMotion(std::span<const Bone> bones);
    /// One bone, at rest in the rest pose.
    explicit DrivenMotion(const Bone& bone = {}) : DrivenMotion(std::span(&bone, 1)) {}
    ~DrivenMotion() override;

    /// Leads all bones from where they are at `from` to these poses at `to`.
    void move_to(std::span<const Pose> poses, double from, double to);
    void move_to(const Pose& pose, double from, double to) { move_to({&pose, 1}, from, to); }
    /// Puts the whole motion elsewhere at once: what was at p is at `by.rotation.rotate(p) +
    /// by.position`, moving as before. `World::teleport` brings the hair along.
    void jump(const Pose& by);

    std::size_t bone_count() const override;
    void evaluate(double time, std::span<BonePose> bones) const override;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// The bust's three bones, led by its head.
class DrivenBust final : public Motion {
  public:
    explicit DrivenBust(const BustJoints& joints = bust_joints());
    DrivenBust(const HeadPose& begin, const BustJoints& joints = bust_joints());
    ~DrivenBust() override;

    /// As with `DrivenMotion`.
    void move_to(const HeadPose& pose, double from, double to);
    void jump(const Pose& by);
    /// Where the head was led to last.
    HeadPose target() const;

    std::size_t bone_count() const override { return kBustBones; }
    void evaluate(double time, std::span<BonePose> bones) const override;

  private:
    struct Data;
    std::unique_ptr<Data> data_;
};

/// Where another motion of a bust has its head at a time: to lead a head along a clip.
HeadPose head_pose(const Motion& bust, double time, const BustJoints& joints = bust_joints());

} // namespace mane
