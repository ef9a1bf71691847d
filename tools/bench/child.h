#pragma once

#include "bench/cases.h"
#include "interrupt.h"

#include <optional>

namespace mane::bench {

/// Runs a case once in a process of its own, so that its memory is its own and its threads are new.
/// Nothing when a signal came meanwhile. Throws what the process failed by: InputError for its bad
/// input, else std::runtime_error.
std::optional<Json> run_in_child(const Case& c, const tool::Interrupt& interrupt);

} // namespace mane::bench
