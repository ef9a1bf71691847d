#pragma once

#include "mane/body.h"
#include "mane/frame.h"
#include "mane/groom.h"
#include "mane/scene.h"

#include <string>
#include <vector>

namespace mane {
class CacheReader;
}

namespace mane::tool {

/// A frame of a cache with all that drawing and export need.
struct StoredFrame {
    Frame frame;
    std::vector<Mesh> bodies; ///< posed, vertices relative to the frame's origin
    Vec3d head_centre;        ///< [m] in the world, amid the roots
    Quatd head_rotation;      ///< from the rest pose
};
StoredFrame load_frame(const CacheReader& cache, std::size_t index);

/// The scene that a cache was made from.
SceneDesc scene_of(const CacheReader& cache, const std::string& file);

} // namespace mane::tool
