#pragma once

#include "mane/frame.h"
#include "mane/groom.h"
#include "model/section_frames.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mane::test {

/// The drawn envelope of one wisp, written from its definition (docs/model.md) in doubles: the
/// obvious twin.
class SlowEnvelope {
  public:
    SlowEnvelope(const Groom& groom, const Frame& frame, std::size_t wisp)
        : k_(groom.envelope_points), sections_(groom.sections(wisp)) {
        const std::size_t first = groom.first_section[wisp];
        for (std::size_t i = 0; i < sections_; ++i)
            centre_.emplace_back(frame.position[first + i]);
        std::vector<SectionFrame<double>> axes(sections_);
        section_frames<double>(centre_, Vec3d(frame.first_axis[wisp]), axes);
        for (std::size_t i = 0; i < sections_; ++i)
            for (std::size_t k = 0; k < k_; ++k) {
                const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(k_);
                const double r = double{frame.radius[(first + i) * k_ + k]};
                half_line_.push_back((axes[i].u * std::cos(angle) + axes[i].v * std::sin(angle)) *
                                     r);
            }
    }

    /// Depth (M14a) of `point` in the section at `p`: the least over the sectors whose plane holds
    /// it, 1 on the surface; infinite if it is in none of them to `tolerance` [m].
    double depth(const Vec3d& point, double p, double tolerance) const {
        const Vec3d q = point - curve(p, [&](std::size_t i) { return centre_[i]; });
        double least = length(q) < tolerance ? 0 : HUGE_VAL;
        for (std::size_t k = 0; k < k_; ++k) {
            const Vec3d a = half_line(p, k), b = half_line(p, (k + 1) % k_);
            const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), det = aa * bb - ab * ab;
            const double alpha = (dot(q, a) * bb - dot(q, b) * ab) / det;
            const double beta = (dot(q, b) * aa - dot(q, a) * ab) / det;
            if (alpha * std::sqrt(aa) < -tolerance || beta * std::sqrt(bb) < -tolerance)
                continue;
            if (length(q - a * alpha - b * beta) > tolerance)
                continue;
            const double c = std::cos(2 * M_PI / static_cast<double>(k_));
            least = std::min(least, std::sqrt(alpha * alpha + beta * beta + 2 * alpha * beta * c));
        }
        return least;
    }

    Vec3d half_line(double p, std::size_t k) const {
        return curve(p, [&](std::size_t i) { return half_line_[i * k_ + k]; });
    }

    /// The Catmull-Rom curve through `points(0) …`, by its four weights, ends duplicated.
    template <typename Points> Vec3d curve(double p, Points points) const {
        const std::size_t last = sections_ - 1;
        const std::size_t i = std::min(static_cast<std::size_t>(p), last - 1);
        const double t = p - static_cast<double>(i);
        const double w[4] = {0.5 * (-t + 2 * t * t - t * t * t),
                             0.5 * (2 - 5 * t * t + 3 * t * t * t),
                             0.5 * (t + 4 * t * t - 3 * t * t * t), 0.5 * (-t * t + t * t * t)};
        return points(i == 0 ? 0 : i - 1) * w[0] + points(i) * w[1] + points(i + 1) * w[2] +
               points(std::min(i + 2, last)) * w[3];
    }

  private:
    std::size_t k_, sections_;
    std::vector<Vec3d> centre_, half_line_;
};

} // namespace mane::test
