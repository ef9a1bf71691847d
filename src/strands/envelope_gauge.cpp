#include "base/functions.h"
#include "mane/strands.h"
#include "model/section_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mane {

EnvelopeGauge::EnvelopeGauge(const Groom& groom, const Frame& frame, std::size_t wisp)
    : half_lines_(groom.envelope_points) {
    const std::size_t first = groom.first_section[wisp], sections = groom.sections(wisp);
    for (std::size_t i = 0; i < sections; ++i)
        centre_.emplace_back(frame.position[first + i]);
    std::vector<SectionFrame<double>> axes(sections);
    section_frames<double>(centre_, Vec3d(frame.first_axis[wisp]), axes);
    for (std::size_t i = 0; i < sections; ++i)
        for (std::size_t k = 0; k < half_lines_; ++k) {
            const double angle =
                2 * kPi * static_cast<double>(k) / static_cast<double>(half_lines_);
            const double r = double{frame.radius[(first + i) * half_lines_ + k]};
            end_.push_back((axes[i].u * cosine(angle) + axes[i].v * sine(angle)) * r);
        }
}

// By the four weights of Catmull-Rom, ends duplicated; `DrawnEnvelope` has the same curve in powers
// of t.
template <typename Points> Vec3d EnvelopeGauge::curve(double p, Points points) const {
    const std::size_t last = centre_.size() - 1;
    const std::size_t i = std::min(static_cast<std::size_t>(p), last - 1);
    const double t = p - static_cast<double>(i);
    const double w[4] = {0.5 * (-t + 2 * t * t - t * t * t), 0.5 * (2 - 5 * t * t + 3 * t * t * t),
                         0.5 * (t + 4 * t * t - 3 * t * t * t), 0.5 * (-t * t + t * t * t)};
    return points(i == 0 ? 0 : i - 1) * w[0] + points(i) * w[1] + points(i + 1) * w[2] +
           points(std::min(i + 2, last)) * w[3];
}

double EnvelopeGauge::depth(const Vec3d& point, double p, double tolerance) const {
    const Vec3d q = point - curve(p, [&](std::size_t i) { return centre_[i]; });
    const auto half_line = [&](std::size_t k) {
        return curve(p, [&](std::size_t i) { return end_[i * half_lines_ + k]; });
    };
    const double between = cosine(2 * kPi / static_cast<double>(half_lines_));
    double least = length(q) < tolerance ? 0 : std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < half_lines_; ++k) {
        const Vec3d a = half_line(k), b = half_line((k + 1) % half_lines_);
        const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), area = aa * bb - ab * ab;
        const double alpha = (dot(q, a) * bb - dot(q, b) * ab) / area;
        const double beta = (dot(q, b) * aa - dot(q, a) * ab) / area;
        const bool in_sector =
            alpha * std::sqrt(aa) >= -tolerance && beta * std::sqrt(bb) >= -tolerance;
        const bool in_plane = length(q - a * alpha - b * beta) <= tolerance;
        if (in_sector && in_plane)
            least = std::min(least,
                             std::sqrt(alpha * alpha + beta * beta + 2 * alpha * beta * between));
    }
    return least;
}

} // namespace mane
