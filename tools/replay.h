#pragma once

#include "mane/cache.h"
#include "mane/scene.h"

#include <string>

namespace mane::tool {

/// A cache as the commands that draw it need it: with the scene that made it.
class Replay {
  public:
    explicit Replay(const std::string& file);

    const Groom& groom() const { return cache_.setup().groom; }
    const std::vector<Body>& bodies() const { return cache_.setup().bodies; }
    const SceneDesc& scene() const { return scene_; }
    const CacheReader& cache() const { return cache_; }
    /// Throws InputError for a frame that the file does not hold.
    Frame frame(std::uint32_t number) const;

  private:
    std::string file_;
    CacheReader cache_;
    SceneDesc scene_;
};

} // namespace mane::tool
