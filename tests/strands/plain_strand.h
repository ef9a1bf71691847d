#pragma once

#include "base/functions.h"
#include "base/random.h"
#include "mane/strands.h"
#include "model/section_frames.h"
#include "random_hair.h"
#include "strands/place.h"

#include <algorithm>
#include <vector>

namespace mane::test {

/// The slow, obvious twin of a strand: docs/model.md's sentences one after the other, in doubles,
/// for one point at a time.
class PlainStrand {
  public:
    PlainStrand(const Hair& hair, const StrandDesc& desc, std::uint32_t seed, std::size_t wisp,
                std::size_t number)
        : hair_(hair), desc_(desc), wisp_(seed, wisp), own_(seed, wisp, number + 1),
          first_(hair.groom.first_section[wisp]), sections_(hair.groom.sections(wisp)) {
        const auto position = std::span(hair.frame.position).subspan(first_, sections_);
        std::vector<Vec3d> points(position.begin(), position.end());
        axes_.resize(sections_);
        section_frames<double>(points, Vec3d(hair.frame.first_axis[wisp]), axes_);
    }

  private:
    // The textbook's four weights, ends duplicated.
    template <typename Points> auto curve(double p, Points points) const {
        const std::size_t last = sections_ - 1;
        const std::size_t i = std::min(static_cast<std::size_t>(p), last - 1);
        const double t = p - static_cast<double>(i);
        return points(i == 0 ? 0 : i - 1) * (0.5 * (-t + 2 * t * t - t * t * t)) +
               points(i) * (0.5 * (2 - 5 * t * t + 3 * t * t * t)) +
               points(i + 1) * (0.5 * (t + 4 * t * t - 3 * t * t * t)) +
               points(std::min(i + 2, last)) * (0.5 * (-t * t + t * t * t));
    }

  public:
    Vec3d at(double p) const {
        const double wave = desc_.waves > 0 ? double{desc_.wave_amplitude} : 0;
        const double disc = (1 - wave) / (1 + double{desc_.jitter} / 8);
        const DiscPoint place = place_in_disc(desc_.distribution, own_, 0);
        const double left = curve(
            p, [&](std::size_t i) { return 1 - double{desc_.jitter} * double{own_.unit(4 + i)}; });
        const double turn = 2 * kPi * double{desc_.curls} * length_to(p) / whole_length();
        const double x = disc * left * double{place.x}, y = disc * left * double{place.y};
        const double height = wave > 0 ? wave * stretched(p) * sine(phase(p)) : 0;
        const double way = 2 * kPi * double{wisp_.unit(0)};
        return envelope(p, x * cosine(turn) - y * sine(turn) + height * cosine(way),
                        x * sine(turn) + y * cosine(turn) + height * sine(way));
    }

  private:
    Vec3d envelope(double p, double x, double y) const {
        const Vec3d centre =
            curve(p, [&](std::size_t i) { return Vec3d(hair_.frame.position[first_ + i]); });
        const std::size_t k_count = hair_.groom.envelope_points;
        const double sector = 2 * kPi / static_cast<double>(k_count);
        double angle = arc_tangent(y, x);
        angle += angle < 0 ? 2 * kPi : 0;
        const auto k = std::min(static_cast<std::size_t>(angle / sector), k_count - 1);
        const double within = angle - static_cast<double>(k) * sector, r = std::sqrt(x * x + y * y);
        return centre + half_line(p, k) * (r * sine(sector - within) / sine(sector)) +
               half_line(p, (k + 1) % k_count) * (r * sine(within) / sine(sector));
    }
    Vec3d half_line(double p, std::size_t k) const {
        const std::size_t k_count = hair_.groom.envelope_points;
        const double angle = 2 * kPi * static_cast<double>(k) / static_cast<double>(k_count);
        return curve(p, [&](std::size_t i) {
            return (axes_[i].u * cosine(angle) + axes_[i].v * sine(angle)) *
                   double{hair_.frame.radius[(first_ + i) * k_count + k]};
        });
    }

    double designed(std::size_t i) const {
        return length(Vec3d(hair_.groom.position[first_ + i + 1]) -
                      Vec3d(hair_.groom.position[first_ + i]));
    }
    double length_to(double p) const {
        double sum = -designed(0); // from x₁ on
        for (std::size_t i = 0; i + 1 < sections_; ++i)
            sum += designed(i) * std::clamp(p - static_cast<double>(i), 0.0, 1.0);
        return sum;
    }
    double whole_length() const { return length_to(static_cast<double>(sections_ - 1)); }
    double phase(double p) const {
        const double own = -0.8 + 1.6 * double{own_.unit(3)};
        return 2 * kPi *
                   (double{wisp_.unit(1)} + double{desc_.waves} * length_to(p) / whole_length()) +
               own;
    }
    /// What stretching leaves of the amplitude: in the middle of a segment its own, at its ends the
    /// mean of both neighbours', linear between.
    double stretched(double p) const {
        const auto own = [&](std::size_t i) {
            const double now = length(Vec3d(hair_.frame.position[first_ + i + 1]) -
                                      Vec3d(hair_.frame.position[first_ + i]));
            return std::min(1.0, designed(i) / now);
        };
        const std::size_t last = sections_ - 2;
        const double from_middle = std::clamp(p - 0.5, 0.0, static_cast<double>(last));
        const std::size_t i = std::min(static_cast<std::size_t>(from_middle), last);
        const double t = from_middle - static_cast<double>(i);
        return own(i) * (1 - t) + own(std::min(i + 1, last)) * t;
    }

    const Hair& hair_;
    StrandDesc desc_;
    Random wisp_, own_;
    std::size_t first_, sections_;
    std::vector<SectionFrame<double>> axes_;
};

} // namespace mane::test
