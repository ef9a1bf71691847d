#pragma once

#include "mane/desc.h"

namespace mane {

/// Throws InputError naming the first parameter that no step can work with: not a number, negative
/// where it must not be, or against another one.
void check_desc(const SimulationDesc& desc);

/// Throws InputError naming the first parameter that differs though it is fixed while a world runs.
void check_fixed(const SimulationDesc& now, const SimulationDesc& next);

} // namespace mane
