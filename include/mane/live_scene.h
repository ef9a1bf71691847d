#pragma once

#include "mane/scene.h"
#include "mane/world.h"

#include <functional>
#include <vector>

namespace mane {

/// A world and the scene that it plays: every field that the table calls live may change while it
/// runs (M46), whether the step reads it or the hair is grown from it.
class LiveScene {
  public:
    /// Grows the hair of a scene anew, in the balance that it had at first: gravity that changes
    /// while a world runs pulls on the hair, and is not what it was designed under.
    using Grow = std::function<Groom(const SceneDesc&)>;

    /// `groom`: what `grow` gives for `scene`. Throws InputError as `World` does.
    LiveScene(const SceneDesc& scene, const Groom& groom, std::vector<Body> bodies, Grow grow,
              double start_time = 0, const RunOptions& options = {});

    /// Another scene from now on. Fields of drawing and judging only have to be live to be kept
    /// here: who draws reads them. Throws InputError, and then changes nothing, where a fixed field
    /// differs, or for what `World::change` refuses.
    void change(const SceneDesc& scene);

    const SceneDesc& scene() const { return scene_; }
    World& world() { return world_; }
    const World& world() const { return world_; }

  private:
    SceneDesc scene_;
    World world_;
    Grow grow_;
};

} // namespace mane
