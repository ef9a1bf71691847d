#pragma once

#include "check/judge.h"

namespace mane::judge {

/// Reads what judges need to know beforehand: the scene's settings, the frames' times, and when the
/// bodies came to rest. Throws InputError for a run without frames or with times that do not rise.
RunView view_run(const CacheReader& run, const CheckOptions& options);

} // namespace mane::judge
