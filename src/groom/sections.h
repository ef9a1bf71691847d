#pragma once

#include "groom/roots.h"
#include "groom/solid.h"
#include "mane/style.h"

#include <span>

namespace mane {

/// A wisp along `line` (x₁ to the tip, evenly spaced points) with `segments` segments of equal
/// length and elliptic sections, wide along the body and flat away from it, each radius shortened
/// where it would reach into the body.
WispDesign cut_sections(const StyleDesc& style, const EnvelopeDesc& envelope,
                        const ScalpPoint& root, std::span<const Vec3d> line, std::uint32_t segments,
                        const Solid& body);

} // namespace mane
