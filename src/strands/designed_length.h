#pragma once

#include "base/functions.h"
#include "mane/groom.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mane {

/// A place along a wisp: p = `piece` + `t`.
struct AlongWisp {
    std::uint32_t piece = 0;
    float t = 0; ///< 0 to 1
};

/// How long every wisp was designed: what belongs to the hair's material (where a strand ends, the
/// phase of its waves, the turn of its curls) is told by it and does not slide when segments
/// stretch.
class DesignedLength {
  public:
    explicit DesignedLength(const Groom& groom);

    /// The segment that p is on, and where on it.
    AlongWisp along(std::size_t wisp, float p) const {
        const std::uint32_t piece = std::min(static_cast<std::uint32_t>(p), pieces(wisp) - 1);
        return {piece, p - static_cast<float>(piece)};
    }
    /// [m] from x₁ to there; negative before x₁.
    float to(std::size_t wisp, AlongWisp at) const {
        const float* s = to_section_.data() + first_section_[wisp] + at.piece;
        return s[0] + (s[1] - s[0]) * at.t;
    }
    /// [m] from x₁ to the tip
    float whole(std::size_t wisp) const { return to_section_[first_section_[wisp + 1] - 1]; }
    /// [m] of segment `piece`
    float segment(std::size_t wisp, std::uint32_t piece) const {
        const float* s = to_section_.data() + first_section_[wisp] + piece;
        return s[1] - s[0];
    }
    /// p at `length` [m] from x₁ on, not beyond the tip.
    float parameter(std::size_t wisp, float length) const;

    /// [rad] by which `curls` turns from x₁ to the tip have turned where `length` [m] has been
    /// designed (M19)
    double turn(std::size_t wisp, double curls, double length) const {
        return 2 * kPi * curls * length / std::max(double{whole(wisp)}, 1e-6);
    }

    std::uint32_t pieces(std::size_t wisp) const {
        return first_section_[wisp + 1] - first_section_[wisp] - 1;
    }
    std::size_t wisp_count() const { return first_section_.size() - 1; }

  private:
    std::vector<std::uint32_t> first_section_; // wisps + 1
    std::vector<float> to_section_;            // [m] per section
};

} // namespace mane
