#pragma once

#include "mane/picture.h"

namespace mane {

/// A camera's rays, in coordinates relative to a frame's origin.
class Lens {
  public:
    Lens(const Camera& camera, const Vec3d& origin, std::uint32_t width, std::uint32_t height);

    Vec3 eye() const { return eye_; }
    /// Unit direction through the picture's point (x, y) in pixels, from the upper left corner.
    Vec3 direction(float x, float y) const;
    Vec3 right() const { return right_; }
    Vec3 up() const { return up_; }
    Vec3 forward() const { return forward_; }

  private:
    Vec3 eye_, forward_, right_, up_;
    float half_width_, half_height_, pixel_; // pixel_: size at distance 1
};

} // namespace mane
