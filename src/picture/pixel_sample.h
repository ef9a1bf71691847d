#pragma once

#include "base/random.h"

#include <cmath>
#include <cstdint>

namespace mane {

/// A point of the unit square.
struct SquarePoint {
    float x = 0;
    float y = 0;
};

/// One of a pixel's samples: its choices over a square, well spread among the pixel's samples by
/// Roberts' R2 sequence (each further point by the powers of 1/1.3247…, the plastic number), and
/// turned at random from pixel to pixel.
class PixelSample {
  public:
    PixelSample(std::uint32_t x, std::uint32_t y, std::uint32_t sample)
        : random_(x, y), sample_(sample) {}

    /// The `n`-th choice.
    SquarePoint point(std::uint32_t n) const {
        const float i = static_cast<float>(sample_);
        return {fraction(random_.unit(2 * n) + i * 0.75487767f),
                fraction(random_.unit(2 * n + 1) + i * 0.56984029f)};
    }

  private:
    static float fraction(float x) { return x - std::floor(x); }

    Random random_;
    std::uint32_t sample_;
};

} // namespace mane
