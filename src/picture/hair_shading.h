#pragma once

#include "mane/vec.h"

namespace mane {

struct HairMaterial {
    Vec3 colour;             ///< [1] light left after passing a strand
    float roughness = 0.32f; ///< [1] of the longitudinal lobes
    float tilt = 0.05f;      ///< [rad] of the cuticle's scales, toward the root
};

/// Light that a strand sends to the viewer from a light of radiance one, scattered once. After
/// Marschner et al. 2003, in the closed-form approximation of Karis 2016: the highlight R on the
/// surface, TT through the strand, and the coloured highlight TRT, shifted apart along the strand
/// by its scales. `tangent` points from root to tip, `viewer` and `light` away from the strand; all
/// unit.
Vec3 scattered_once(const HairMaterial& material, const Vec3& tangent, const Vec3& viewer,
                    const Vec3& light);

/// The same for light that has been through other strands: it has lost its direction, so what is
/// left of it looks matt. Where little light arrives (`lit`, its share) it has passed more strands
/// and is more saturated.
Vec3 scattered_often(const HairMaterial& material, const Vec3& tangent, const Vec3& viewer,
                     const Vec3& light, const Vec3& lit);

} // namespace mane
