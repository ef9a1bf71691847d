#pragma once

#include "mane/body.h"
#include "mane/clip.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace mane {

/// The bones that every built-in motion and every clip drives, in this order.
enum BustBone : std::uint32_t { kChestBone, kNeckBone, kHeadBone, kBustBones };

/// Where the three bones turn in the rest pose [m].
struct BustJoints {
    Vec3d chest; ///< between the shoulder blades
    Vec3d neck;  ///< the last vertebra of the neck
    Vec3d head;  ///< where the skull sits on the neck
};

/// The joints of the built-in bust.
BustJoints bust_joints();

/// The built-in bust: head with face and ears, neck, shoulders and upper chest of a woman of 1.65
/// m, facing +Z, the head's centre at about y = 1.55 m. One closed surface of 3,000 to 9,000
/// triangles, skinned to the three bones. It has no motion yet.
Body make_bust();

/// The triangles of the built-in bust inside the hairline, in rising order: from the forehead over
/// the temples, around the ears, down to the nape.
std::vector<std::uint32_t> bust_scalp(const Body& bust);

/// How a head sits on its shoulders, as a person would turn it [rad].
struct HeadTurn {
    double yaw = 0;   ///< to the left
    double pitch = 0; ///< nods down
    double roll = 0;  ///< leans to the right shoulder
};

/// Lifelike motion of the three bones, 11 s long: looks around, shakes ("no"), nods, bows, a quick
/// whirl of one and a half turns, and a toss. At rest before time 0 and after the end; it starts
/// and ends in the rest pose, C² throughout.
std::shared_ptr<const Motion> builtin_motion(const BustJoints& joints = bust_joints());

/// Shakes the head for ever, on shoulders that stand still: a yaw of `angle` sin(2π `rate` t) [rad,
/// Hz]. Throws InputError for values that are not finite or a rate that is not over 0.
std::shared_ptr<const Motion> shake_motion(double angle, double rate,
                                           const BustJoints& joints = bust_joints());

/// How a clip drives the three bones.
struct ClipMotionDesc {
    double unit = 1;         ///< [m] one unit of the clip's positions
    double fps = 0;          ///< [Hz] true frame rate; 0: as the file says
    std::uint32_t first = 1; ///< frame of the clip that is time 0
    std::uint32_t last = std::numeric_limits<std::uint32_t>::max(); ///< last frame used
    /// First frame of the clip that is captured motion: those before it (a T-pose, a jump) are
    /// never used. Frames from here to `first` are the motion at negative times. Never later than
    /// `first`.
    std::uint32_t earliest = 1;
    double lowpass = 20; ///< [Hz] cut-off of the Gaussian low-pass (−3 dB there); 0: none
    std::string
        chest; ///< joint names; empty: found by the naming families of CMU, DAZ and Motion Builder
    std::string neck;
    std::string head;
};

/// Motion captured in a clip. The head joint moves exactly as the clip's (it carries the hair); the
/// chest turns as the clip's, the neck halfway between both, and they hang from the head by the
/// bust's own proportions. With all rotations zero the bust is upright and faces +Z, as in its rest
/// pose. Positions and quaternions are low-passed, then joined by C² cubic splines; before the
/// first and after the last usable frame the motion comes to rest smoothly within half a second.
/// Throws InputError for unknown joints and empty ranges.
std::shared_ptr<const Motion> clip_motion(const Clip& clip, const ClipMotionDesc& desc,
                                          const BustJoints& joints = bust_joints());

/// Where a rigid obstacle is at a time.
struct MotionKey {
    double time = 0; ///< [s]
    Vec3d position;  ///< [m] of the obstacle's own origin
    Quatd rotation;  ///< any length but zero
};

/// One rigid bone that passes through all keys, C², at rest before the first and after the last.
/// Throws InputError when there is no key, when times do not rise, or when a key is not finite.
std::shared_ptr<const Motion> keyframed_motion(const std::vector<MotionKey>& keys);

/// `motion` until `time` [s], then slower, at rest from `time + duration` on; C².
std::shared_ptr<const Motion> frozen_motion(std::shared_ptr<const Motion> motion, double time,
                                            double duration = 0.25);

} // namespace mane
