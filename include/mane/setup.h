#pragma once

#include "mane/body.h"
#include "mane/groom.h"
#include "mane/live_scene.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace mane {

struct SceneDesc;
struct MotionDesc;

/// What a run is made of and what stays the same over all its frames.
struct RunSetup {
    std::string scene; ///< the whole scene as TOML (`write_scene`)
    Groom groom;
    std::vector<Body> bodies; ///< the wearer first
    std::vector<std::string>
        warnings; ///< of what can be used but should be known, such as open edges
};

/// Reads the files that a scene names, makes the bodies with their motions and grows the hair.
/// Throws InputError.
RunSetup prepare(const SceneDesc& scene);
/// The same with a character that `motion` moves, whatever the scene says of it: a host's, for a
/// bust's bones.
RunSetup prepare(const SceneDesc& scene, std::shared_ptr<const Motion> motion);

/// The hair of a scene on a wearer, as `prepare` grows it, in balance under `gravity` [m/s²].
/// Throws InputError.
Groom grow_hair(const SceneDesc& scene, const Body& wearer, const Vec3& gravity);

/// What `prepare` made of a scene as a world to play with, from `start_time` [s] on.
LiveScene make_live(const SceneDesc& scene, const RunSetup& setup, double start_time = 0,
                    const RunOptions& options = {});

/// One bone that follows a bone of another motion: a hat on its head.
std::shared_ptr<const Motion> following_motion(std::shared_ptr<const Motion> leader,
                                               std::uint32_t bone);
/// The motion of a bust's bones that a scene describes; null if it is to stay still. Throws
/// InputError.
std::shared_ptr<const Motion> make_motion(const MotionDesc& desc);

} // namespace mane
