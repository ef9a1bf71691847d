#pragma once

#include "mane/style.h"

namespace mane::test {

struct NamedStyle {
    const char* name;
    HairDesc hair;
    double segments;      ///< mean per wisp
    double intersections; ///< per segment, in motion (§5.3)
};

/// The three styles of §5.3.
inline std::vector<NamedStyle> three_styles() {
    NamedStyle s{"short", {}, 4.0, 17.5}, m{"medium", {}, 9.9, 21.0}, l{"long", {}, 7.7, 12.8};
    StyleDesc& a = s.hair.style;
    a.wisps = 199, a.segments = 4, a.nape_length = 0.11f, a.crown_length = 0.135f,
    a.length_variation = 0.04f;
    a.root_radius = 0.018f, a.radius = 0.02f, a.tip_radius = 0.013f, a.thickness = 0.7f,
    a.widest = 0.5f;
    a.parting = 0.02f, a.root_angle = 35, a.drape = 0.03f, a.volume = 0.015f;
    StyleDesc& b = m.hair.style;
    b.wisps = 73, b.segments = 9.9f, b.nape_length = 0.26f, b.crown_length = 0.34f;
    b.root_radius = 0.027f, b.radius = 0.032f, b.tip_radius = 0.016f, b.widest = 0.5f;
    m.hair.skeleton.strain = 0.0055f;
    // long: the defaults
    return {s, m, l};
}

} // namespace mane::test
