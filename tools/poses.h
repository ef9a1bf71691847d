#pragma once

#include "mane/body.h"
#include "mane/cache.h"

#include <vector>

namespace mane::tool {

/// The bones of all bodies at a time [s], as a cache stores them.
BodyPoses poses_at(const std::vector<Body>& bodies, double time);

} // namespace mane::tool
