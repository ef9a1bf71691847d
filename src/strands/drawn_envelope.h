#pragma once

#include "base/parallel_for.h"
#include "mane/frame.h"
#include "mane/groom.h"
#include "strands/place.h"

#include <cstdint>
#include <vector>

namespace mane {

/// The drawn envelope of every wisp in one frame (M14a): the one definition for strands, the
/// envelope's mesh and M17.
///
/// A place on a wisp is a parameter p, whole at the sections, 0 at x₀. There the curve's centre c
/// and its half lines' ends a_k (relative to c) follow Catmull-Rom curves through the sections',
/// ends duplicated. A disc point (x, y) lies between two half lines, x, y = α d_k + β d_{k+1} in
/// the plane, and stands for the point c + α a_k + β a_{k+1}: on the surface where x² + y² = α² +
/// β² + 2αβ cos(2π/K) = 1, an arc of an ellipse, and inside where it is less.
class DrawnEnvelope {
  public:
    explicit DrawnEnvelope(const Groom& groom);
    /// Of a frame of that groom. Throws InputError for one that does not fit it.
    void pose(const Frame& frame, Threads& threads);

    std::uint32_t half_lines() const { return static_cast<std::uint32_t>(forms_.size()); }
    std::uint32_t pieces(std::size_t wisp) const {
        return first_section_[wisp + 1] - first_section_[wisp] - 1;
    }

    /// The point of wisp `wisp` at `p` = `piece` + `t` that `disc` stands for; `piece` is a segment
    /// of the wisp.
    Vec3 at(std::size_t wisp, std::uint32_t piece, float t, DiscPoint disc) const;
    /// The skeleton's curve.
    Vec3 centre(std::size_t wisp, std::uint32_t piece, float t) const;

    /// A disc point's place between two half lines: k, α and β.
    struct Between {
        std::uint32_t k = 0;
        float first = 0, second = 0;
    };
    Between between(DiscPoint disc) const;

    /// The control points of a wisp as rows of `pieces` + 3 numbers: x, y, z of the centre, then
    /// those of each half line's end. A curve's piece i has the entries i … i + 3 of a row; behind
    /// the last row there are kPadding more that may be read.
    const float* control(std::size_t wisp) const { return control_.data() + first_control_[wisp]; }
    static constexpr std::size_t kPadding = 32;

    /// Half line d_k, and the linear forms of a disc point that are α in the sector behind it
    /// (d_k, d_{k+1}) and β in the one before it (d_{k−1}, d_k).
    struct HalfLineForms {
        DiscPoint direction, behind, before;
    };
    const std::vector<HalfLineForms>& forms() const { return forms_; }

  private:
    void pose_wisp(const Frame& frame, std::size_t wisp);
    Vec3 curve(std::size_t wisp, std::uint32_t which, std::uint32_t piece, float t) const;

    std::vector<HalfLineForms> forms_;
    std::vector<std::uint32_t> first_section_; // wisps + 1
    std::vector<std::size_t> first_control_;   // wisps
    std::vector<float> control_;
};

} // namespace mane
