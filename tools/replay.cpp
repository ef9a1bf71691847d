#include "replay.h"

#include "mane/error.h"

#include <fmt/core.h>

namespace mane::tool {

Replay::Replay(const std::string& file)
    : file_(file), cache_(file),
      scene_(parse_scene(cache_.setup().scene, file + " (its scene)", {})) {}

Frame Replay::frame(std::uint32_t number) const {
    if (number >= cache_.frame_count())
        throw InputError(fmt::format("{}: there is no frame {}, expected 0 to {}", file_, number,
                                     static_cast<std::int64_t>(cache_.frame_count()) - 1));
    return cache_.frame(number);
}

} // namespace mane::tool
