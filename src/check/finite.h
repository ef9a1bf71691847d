#pragma once

#include "mane/frame.h"
#include "mane/groom.h"
#include "mane/vec.h"

#include <optional>
#include <span>
#include <vector>

namespace mane::judge {

/// The first section with a number that is not finite, or with a negative radius.
std::optional<std::size_t> first_bad_section(const Groom& groom, const Frame& frame);

/// Whether all vertices of all bodies are finite.
bool all_finite(const std::vector<std::vector<Vec3>>& vertices);

} // namespace mane::judge
