#pragma once

#include "mane/body.h"
#include "mane/groom.h"

namespace mane {

/// Throws InputError for a groom that is not whole (arrays of another size, numbers that are not
/// finite, what has no mass) or does not fit its wearer's mesh.
void check_groom(const Groom& groom, const Mesh& wearer);

/// Throws InputError unless the two have the same wisps, with the same sections, rooted at the same
/// places.
void check_same_topology(const Groom& now, const Groom& next);

} // namespace mane
