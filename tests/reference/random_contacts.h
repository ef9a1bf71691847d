#pragma once

#include "reference/interactions.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mane::reference {

/// Contacts between any points and any segments of the hair, wherever they are: skeleton, envelope
/// and axis points, both kinds, several on the same point, kinematic sections too. None where the
/// hair has no segments.
std::vector<Contact> random_contacts(const Hair& hair, std::size_t count, std::uint64_t seed);

} // namespace mane::reference
