#pragma once

#include "mane/desc.h"
#include "mane/fields.h"

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

/// All that a scene file says. Its keys are those of the table of fields.
struct SceneDesc {
    SimulationDesc simulation;
    SkeletonDesc skeleton;
    EnvelopeDesc envelope;
    StrandDesc strands;
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
