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
    a.wisps = 199, a.segments = 4.0f, a.nape_length = 0.11f, a.crown_length = 0.13f,
    a.length_variation = 0.04f;
    a.root_radius = 0.016f, a.radius = 0.018f, a.tip_radius = 0.012f, a.thickness = 0.7f,
    a.volume = 0.015f;
    a.parting = 0.02f;
    StyleDesc& b = m.hair.style;
    b.wisps = 73, b.segments = 9.9f, b.nape_length = 0.24f, b.crown_length = 0.32f;
    b.root_radius = 0.026f, b.radius = 0.03f, b.tip_radius = 0.015f, b.parting = 0,
    b.root_angle = 25;
    m.hair.skeleton.strain = 0.006f;
    StyleDesc& c = l.hair.style;
    c.wisps = 56, c.segments = 7.7f, c.nape_length = 0.34f, c.crown_length = 0.46f, c.widest = 0.4f;
    c.root_radius = 0.03f, c.radius = 0.035f, c.tip_radius = 0.017f, c.parting = 0,
    c.root_angle = 25;
    return {s, m, l};
}

} // namespace mane::test
