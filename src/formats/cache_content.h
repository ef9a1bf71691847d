#pragma once

#include "formats/arrays.h"
#include "mane/cache.h"

/// What each type of chunk holds: a public type and its named arrays, both ways.
namespace mane {

Bytes pack_text(std::string_view text);
std::string unpack_text(const ArrayReader& chunk);

Bytes pack_groom(const Groom& groom);
Groom unpack_groom(const ArrayReader& chunk);

Bytes pack_body(const Body& body);
Body unpack_body(const ArrayReader& chunk);

Bytes pack_frame(const Frame& frame, const BodyPoses& poses);
/// Throws InputError when the frame does not fit the groom.
Frame unpack_frame(const ArrayReader& chunk, const Groom& groom);
BodyPoses unpack_poses(const ArrayReader& chunk, std::size_t bodies);

Bytes pack_table(std::span<const Column> table);
std::vector<Column> unpack_table(const ArrayReader& chunk);

} // namespace mane
