#pragma once

#include "mane/character.h"
#include "mane/check.h"
#include "mane/desc.h"
#include "mane/fields.h"
#include "mane/style.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mane {

/// Other values for some wisps: `[[override]] wisps = [3, 4]  skeleton.strain = 0.01`.
struct WispOverride {
    std::vector<std::uint32_t> wisps;
    std::vector<std::pair<std::string, Value>>
        settings; ///< full key and value, per-wisp fields only
};

/// Who wears the hair.
struct CharacterDesc {
    std::string mesh;  ///< OBJ file, closed or nearly so; empty: the built-in bust
    double unit = 1;   ///< [m] one unit of the mesh's coordinates
    Vec3 offset;       ///< [m] moves the mesh, so that its head turns where the bust's does
    Vec3 scalp_centre; ///< [m] middle of the ball whose triangles are the scalp, in the rest pose
    float scalp_radius = 0; ///< [m] of that ball; 0: the built-in bust's own scalp
};

/// What moves the character.
struct MotionDesc {
    std::string clip; ///< BVH file; empty: the built-in motion
    ClipMotionDesc drive;
    double shake = 0;      ///< [deg] the head shakes by this to both sides instead; 0: not
    double shake_rate = 1; ///< [Hz] of that shake
    bool still = false;    ///< the character does not move at all
    double freeze = 0;     ///< [s] from this time on the motion comes to rest; 0: never
};

/// What an obstacle looks like.
enum class ObstacleShape : std::uint8_t { box, sphere, mesh };

/// Where an obstacle is at a time.
struct ObstacleKeyDesc {
    double time = 0; ///< [s]
    Vec3 position;   ///< [m] of the obstacle's own origin
    Vec3 rotation;   ///< [deg] about this axis by its length
};

/// A body beside the character (M34).
struct ObstacleDesc {
    std::string name = "obstacle";            ///< for messages and pictures
    ObstacleShape shape = ObstacleShape::box; ///< a box, an ellipsoid or a file
    Vec3 size = {0.2f, 0.2f, 0.2f};           ///< [m] of a box or ellipsoid, along its axes
    std::string mesh;                         ///< OBJ file, for the shape "mesh"
    double unit = 1;                          ///< [m] one unit of the mesh's coordinates
    bool worn = false; ///< a hat: it moves with the head and wisps may start inside it
    std::vector<ObstacleKeyDesc> keys; ///< its motion, at rest before the first and after the last
};

/// All that a scene file says. Its keys are those of the table of fields.
struct SceneDesc {
    SimulationDesc simulation;
    HairDesc hair;
    CharacterDesc character;
    MotionDesc motion;
    std::vector<ObstacleDesc> obstacles;
    CheckDesc check;
    std::vector<WispOverride> overrides;
};

/// The scene as wisp `wisp` sees it: with all overrides that name it, the later ones last.
SceneDesc scene_of_wisp(const SceneDesc& scene, std::uint32_t wisp);

/// The rates of §5.3 and ours (M36): `paper` 1000/120/24, `default` 1000/120/120, `fine`
/// 1000/1000/1000 Hz; `paper-literal` is `paper` with contacts answered only when found and the
/// printed ½. Throws InputError for another name.
void apply_rates(SceneDesc& scene, std::string_view preset);

/// Conditions between fields. Throws InputError "`where`: …".
void check_scene(const SceneDesc& scene, const std::string& where);

/// A closed box or ellipsoid around its origin. Throws InputError for the shape "mesh", which is a
/// file's.
Mesh obstacle_mesh(const ObstacleDesc& obstacle);
/// An obstacle's keys as `keyframed_motion` takes them.
std::vector<MotionKey> obstacle_keys(const ObstacleDesc& obstacle);

/// Reads a scene file (TOML). Throws InputError with file and line.
SceneDesc read_scene(const std::filesystem::path& file);
/// Reads a scene from text; `name` stands for the file in messages, `folder` is where relative
/// paths start.
SceneDesc parse_scene(std::string_view text, const std::string& name,
                      const std::filesystem::path& folder);
/// Applies `section.key=value`, with the value as in a scene file or bare: `wisps.mode=off`,
/// `air.wind=[1,0,0]`, `skeleton.bending_length=6cm`. Throws InputError.
void apply_setting(SceneDesc& scene, std::string_view setting);

/// The whole scene as TOML, every field written out; reading it gives an equal scene.
std::string write_scene(const SceneDesc& scene);
/// A JSON schema of scene files, for editors.
std::string scene_schema();

} // namespace mane
