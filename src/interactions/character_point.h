#pragma once

#include "mane/vec.h"
#include "model/state.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// A point of a wisp that can touch a body (§4.2): Σ_j w_j (x_j + α r_k d_k + β r_{k+1} d_{k+1})
/// over the two sections of a segment, with weights 1 − along and along. One definition for
/// skeleton points (α = β = 0, along = 0), envelope points (α = 1), points of the axis between
/// sections, and points of the drawn surface between half lines (M14a), so that all answer alike.
struct WispPoint {
    std::uint32_t section = 0; ///< the segment's first section, index along the wisp from x₀
    float along = 0;           ///< 0 on `section`, 1 on the next
    std::uint32_t k = 0;       ///< first half line of the sector
    float alpha = 0;           ///< share along half line k
    float beta = 0;            ///< share along half line k + 1

    /// How many sections it is a point of, and the share of each.
    std::uint32_t sections() const { return along > 0 ? 2 : 1; }
    float weight(std::uint32_t j) const { return j == 0 ? 1 - along : along; }
    bool on_axis() const { return alpha == 0 && beta == 0; }
    /// The point of the axis that it hangs on.
    WispPoint axis() const { return {section, along, 0, 0, 0}; }
    bool operator==(const WispPoint&) const = default;
};

/// One wisp, unpacked: what detection and the penetration reaction read and write. Indices are
/// sections from x₀.
class WispCopy {
  public:
    /// Reads wisp `number` of `hair`: positions, half lines, radii, velocities, who answers.
    void load(const HairView& hair, std::uint32_t number);
    /// Writes a section's position and radii back.
    void store_place(const HairView& hair, std::uint32_t section, State& state) const;

    std::uint32_t sections() const { return static_cast<std::uint32_t>(x.size()); }
    std::uint32_t k() const { return static_cast<std::uint32_t>(lines_.size()); }
    static bool simulated(std::uint32_t section) { return section >= 2; }
    /// Whether a section answers: simulated and not pinned.
    bool answers(std::uint32_t section) const { return answers_[section] != 0; }

    float& r(std::uint32_t section, std::uint32_t line) { return radius[section * k() + line]; }
    float r(std::uint32_t section, std::uint32_t line) const {
        return radius[section * k() + line];
    }
    float& rate(std::uint32_t section, std::uint32_t line) {
        return radius_rate[section * k() + line];
    }
    float rate(std::uint32_t section, std::uint32_t line) const {
        return radius_rate[section * k() + line];
    }
    /// Half line `line` of a section.
    const Vec3& d(std::uint32_t section, std::uint32_t line) const {
        return directions[section * k() + line];
    }
    std::uint32_t next(std::uint32_t line) const { return line + 1 == k() ? 0 : line + 1; }
    float largest_radius(std::uint32_t section) const;

    Vec3 position(const WispPoint& p) const;
    Vec3 velocity(const WispPoint& p) const;

    /// The middle of the drawn arc from half line `line` of a section to the next.
    WispPoint half_arc(std::uint32_t section, std::uint32_t line) const {
        return {section, 0, line, half_arc_, half_arc_};
    }
    /// The point of a strand's curve halfway from section i − 1 (not the first) to i: Catmull-Rom
    /// through its places in four sections. `place` says where in a section; its section does not
    /// count.
    Vec3 halfway(std::uint32_t i, const WispPoint& place) const;

    std::vector<Vec3> x, v;                 ///< position and velocity per section
    std::vector<float> radius, radius_rate; ///< K per section
    std::vector<Vec3> directions;           ///< K half lines per section

  private:
    Slot slot(const HairView& hair, std::uint32_t section) const;
    Vec3 offset(std::uint32_t section, const WispPoint& p) const;
    Vec3 offset_rate(std::uint32_t section, const WispPoint& p) const;

    std::uint32_t number_ = 0;
    std::span<const HalfLine> lines_;
    std::vector<std::uint8_t> answers_;
    float half_arc_ = 0; // the share of both half lines in the middle of an arc
};

inline Vec3 WispCopy::offset(std::uint32_t s, const WispPoint& p) const {
    if (p.alpha == 0 && p.beta == 0)
        return {};
    return d(s, p.k) * (p.alpha * r(s, p.k)) + d(s, next(p.k)) * (p.beta * r(s, next(p.k)));
}

inline Vec3 WispCopy::offset_rate(std::uint32_t s, const WispPoint& p) const {
    if (p.alpha == 0 && p.beta == 0)
        return {};
    return d(s, p.k) * (p.alpha * rate(s, p.k)) + d(s, next(p.k)) * (p.beta * rate(s, next(p.k)));
}

inline Vec3 WispCopy::position(const WispPoint& p) const {
    if (p.along == 0)
        return x[p.section] + offset(p.section, p);
    return (x[p.section] + offset(p.section, p)) * (1 - p.along) +
           (x[p.section + 1] + offset(p.section + 1, p)) * p.along;
}

inline Vec3 WispCopy::velocity(const WispPoint& p) const {
    if (p.along == 0)
        return v[p.section] + offset_rate(p.section, p);
    return (v[p.section] + offset_rate(p.section, p)) * (1 - p.along) +
           (v[p.section + 1] + offset_rate(p.section + 1, p)) * p.along;
}

/// The point of a section's contact surface farthest along `g` in a plane through it: where a flat
/// wall facing −g touches first. Empty when no sector of the envelope faces g.
WispPoint support_point(const WispCopy& wisp, std::uint32_t section, float along, const Vec3& g);

} // namespace mane
