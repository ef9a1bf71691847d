#pragma once

#include "lead.h"

#include "mane/live_scene.h"
#include "mane/scene.h"
#include "mane/setup.h"
#include "mane/world.h"

#include <memory>
#include <string>

namespace mane::page {

/// A scene and its world as a page works on them: settings change while it runs, and whatever
/// cannot be used leaves everything as it was. All members throw InputError.
class Session {
  public:
    explicit Session(unsigned threads) : threads_(threads) {}

    /// Reads a scene (TOML) and builds its world. Files are where `text` names them; relative names
    /// start at /.
    void open(const std::string& text, const std::string& name);
    /// Applies lines of `section.key = value`. Most fields change the running world; those that
    /// make other hair or bodies begin it anew.
    void set(const std::string& lines);
    /// A preset of the rates.
    void set_rates(const std::string& preset);
    /// A clip moves the character from now on. What a unit of it is, is told from its skeleton's
    /// size.
    void take_clip(const std::string& file);
    /// The scene as it is now, from its first frame.
    void restart();

    /// Simulates until the next frame.
    void advance();
    /// A hand holds the head from now on.
    void hold(const Hold& hold) { lead_->hold(hold); }
    /// Holds a skeleton point at a place in the world [m], and lets it go.
    void pin(std::uint32_t section, const Vec3d& place);
    void release(std::uint32_t section);
    void release_all();
    /// The character is elsewhere at once, with its hair.
    void teleport(const Vec3d& by);

    const std::string& name() const { return name_; }
    const SceneDesc& scene() const { return scene_; }
    const RunSetup& setup() const { return *setup_; }
    const World& world() const { return live_->world(); }
    /// How often a world was built.
    unsigned worlds() const { return worlds_; }

  private:
    void change_to(const SceneDesc& scene);
    void build(const SceneDesc& scene);
    void begin(const SceneDesc& scene, const RunSetup& setup);

    unsigned threads_;
    unsigned worlds_ = 0;
    std::string name_;
    SceneDesc scene_;
    std::unique_ptr<Lead> lead_; ///< of the character
    std::unique_ptr<RunSetup> setup_;
    std::unique_ptr<LiveScene> live_;
};

} // namespace mane::page
