#pragma once

#include "mane/vec.h"

namespace mane {

struct HairMaterial {
    Vec3 colour;             ///< [1] light left after passing a strand
    float roughness = 0.32f; ///< [1] of the longitudinal lobes
    float tilt = 0.05f;      ///< [rad] of the cuticle's scales, toward the root
};

/// Light that a strand sends to the viewer from a light of radiance one (per channel). A model
/// after Marschner et al. 2003 in the closed-form approximation of Karis 2016: the highlight R on
/// the surface, TT through the strand, the coloured highlight TRT, shifted apart along the strand
/// by the scales; and light that has passed many strands. `tangent` points from root to tip,
/// `viewer` and `light` away from the strand; all unit. `lit` is how much light reaches it, for the
/// last part's colour.
Vec3 hair_scattering(const HairMaterial& material, const Vec3& tangent, const Vec3& viewer,
                     const Vec3& light, const Vec3& lit);

} // namespace mane
