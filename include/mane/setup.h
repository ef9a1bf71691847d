#pragma once

#include "mane/body.h"
#include "mane/groom.h"

#include <string>
#include <vector>

namespace mane {

struct SceneDesc;

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

} // namespace mane
