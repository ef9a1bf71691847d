#pragma once

#include "mane/vec.h"

#include <cstdint>
#include <span>

namespace mane {

/// Puts the numbers of places in an order in which what follows each other is together, for a tree
/// of sixteens: cut along the longest side of the box that holds them into halves that fill whole
/// nodes, and those again, down to sixteen, which stand by rising number. Of equal places the lower
/// number comes first, so every library makes the same cuts (M39).
void order_by_sixteens(std::span<const Vec3> places, std::span<std::uint32_t> numbers);

} // namespace mane
