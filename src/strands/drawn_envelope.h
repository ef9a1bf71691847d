#pragma once

#include "mane/frame.h"
#include "mane/groom.h"
#include "strands/catmull_rom.h"
#include "strands/place.h"

#include <cstdint>
#include <vector>

namespace mane {

/// The drawn envelope of every wisp in one frame (M14a): the one definition for strands, the
/// envelope's mesh and M17.
///
/// A place on a wisp is a parameter p, whole at the sections, 0 at x₀. There the curve's centre c
/// and its half lines' ends a_k (relative to c) follow Catmull-Rom pieces through the sections',
/// ends duplicated. A disc point (x, y) lies between two half lines, x, y = α d_k + β d_{k+1} in
/// the plane, and stands for the point c + α a_k + β a_{k+1}: on the surface where x² + y² = α² +
/// β² + 2αβ cos(2π/K) = 1, an arc of an ellipse, and inside where it is less.
class DrawnEnvelope {
  public:
    DrawnEnvelope(const Groom& groom, const Frame& frame);

    /// The point of wisp `wisp` at `p` = `piece` + `t` that `disc` stands for; `piece` is a segment
    /// of the wisp.
    Vec3 at(std::size_t wisp, std::uint32_t piece, float t, DiscPoint disc) const;
    /// The skeleton's curve.
    Vec3 centre(std::size_t wisp, std::uint32_t piece, float t) const;
    std::uint32_t pieces(std::size_t wisp) const { return pieces_[wisp]; }

  private:
    const CatmullRom<Vec3>* piece_curves(std::size_t wisp, std::uint32_t piece) const {
        return curves_.data() + (first_piece_[wisp] + piece) * (half_lines_ + 1);
    }

    std::uint32_t half_lines_;
    std::vector<std::size_t> first_piece_; // per wisp
    std::vector<std::uint32_t> pieces_;    // per wisp
    std::vector<CatmullRom<Vec3>> curves_; // per piece: the centre, then each half line's end
    struct Sector {
        DiscPoint direction, to_first,
            to_second; // of d_k; α and β are dot products with the last two
    };
    std::vector<Sector> sectors_;
};

} // namespace mane
