#pragma once

#include "mane/curves.h"
#include "picture/camera.h"
#include "picture/pixel_sample.h"
#include "picture/ray_scene.h"
#include "picture/shadow_volume.h"

#include <array>
#include <optional>

namespace mane {

/// A distant soft light.
struct Light {
    Vec3 direction; ///< unit, toward the light
    Vec3 radiance;
    float spread; ///< [rad] half-angle seen from the scene
};

/// Three lights that go with the camera, key, fill and rim, a sky, and what shades them: strands by
/// optical depth in a grid, bodies by rays.
class Lighting {
  public:
    static constexpr std::size_t kLights = 3;

    /// `strands` may be empty; `body_rays` holds the bodies and must outlive this. Of the bodies
    /// only the first, the character, shades the sky: an obstacle may be as large as a floor.
    Lighting(const Lens& lens, const Curves& strands, float width_scale,
             std::span<const PictureBody> bodies, const RayScene& body_rays);

    const Light& light(std::size_t i) const { return lights_[i]; }
    /// Share of light `i` that reaches `p`, per channel; `tint` is what a strand leaves of it, and
    /// `at` chooses a point of the light.
    Vec3 reaching(std::size_t i, const Vec3& p, const Vec3& tint, SquarePoint at) const;
    /// Light of the sky at `p`, shaded by hair and bodies.
    Vec3 sky(const Vec3& p) const;

  private:
    std::array<Light, kLights> lights_;
    const RayScene& body_rays_;
    std::vector<Volume> depth_; // per light
    std::optional<Volume> open_sky_;
};

} // namespace mane
