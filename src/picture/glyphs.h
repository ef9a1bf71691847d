#pragma once

#include <array>
#include <cstdint>

namespace mane {

inline constexpr int kGlyphWidth = 5, kGlyphHeight = 7;

/// A letter's rows from the top, five pixels each, the left one in bit 4. Small letters look like
/// capitals; what has no glyph is a blank.
std::array<std::uint8_t, kGlyphHeight> glyph(char letter);

} // namespace mane
