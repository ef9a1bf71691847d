#include "commands.h"

#include "mane/error.h"
#include "mane/scene.h"

#include <cstdio>

namespace mane::tool {

int help_scene(const HelpSceneOptions& options) {
    if (options.schema) {
        std::fputs(scene_schema().c_str(), stdout);
        return 0;
    }
    const std::string text = options.section.empty() ? scene_help() : section_help(options.section);
    if (text.empty())
        throw InputError("help scene: there is no section [" + options.section +
                         "]; `mane help scene` shows all");
    std::fputs(text.c_str(), stdout);
    return 0;
}

} // namespace mane::tool
