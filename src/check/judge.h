#pragma once

#include "check/hair_geometry.h"
#include "check/overlap.h"
#include "check/solid.h"
#include "mane/cache.h"
#include "mane/check.h"
#include "mane/desc.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace mane::judge {

/// What a judge knows of a run before it sees the first frame.
struct RunView {
    const Groom& groom;
    const std::vector<Body>& bodies;
    SimulationDesc simulation;
    StrandDesc strands;
    CheckDesc bounds;
    CheckOptions options;
    std::vector<double> time;   ///< [s] of every frame
    std::optional<double> stop; ///< [s] no body moves from here on to the last frame
    std::string statistics;     ///< JSON, or empty
    std::string damage;         ///< why the file is not whole, or empty

    /// [s] from one frame to the next; 0 for a single one.
    double frame_time() const {
        return time.size() > 1 ? (time.back() - time.front()) / static_cast<double>(time.size() - 1)
                               : 0;
    }
};

/// What a judge sees of one frame. All its numbers are finite.
struct FrameView {
    std::uint32_t number; ///< in the file, from 0
    double time;          ///< [s]
    const Frame& frame;
    const HairGeometry& hair;
    const Overlaps& overlaps; ///< segments that intersect
    const BodyPoses& poses;
    const std::vector<std::vector<Vec3>>&
        vertices;                  ///< [m] per body, relative to the frame's origin
    std::span<const Solid> solids; ///< the bodies that hair must not be in
};

/// Judges one matter over a run.
class Judge {
  public:
    virtual ~Judge() = default;
    /// Called for every frame, in order; frames that hold numbers that are not finite are left out.
    virtual void see(const FrameView& view) = 0;
    /// Called once, behind the last frame.
    virtual void report(std::vector<Criterion>& criteria) const = 0;
};

using JudgePointer = std::unique_ptr<Judge>;
JudgePointer skeleton_judge(const RunView& run);     ///< M33: inside, and axes that stay through
JudgePointer strand_judge(const RunView& run);       ///< M33, M17: what shows
JudgePointer shape_judge(const RunView& run);        ///< stretch, area
JudgePointer tip_judge(const RunView& run);          ///< attached, not thrown off, not frozen
JudgePointer energy_judge(const RunView& run);       ///< kinetic energy
JudgePointer rest_judge(const RunView& run);         ///< after the motion stopped
JudgePointer intersection_judge(const RunView& run); ///< M40, M41: crossings
JudgePointer parting_judge(const RunView& run);      ///< M41: partings between wisps

/// Keeps the largest value seen and where that was.
struct Largest {
    double value = -std::numeric_limits<double>::infinity();
    Offender where;
    bool see(double v, const Offender& at) {
        if (!(v > value))
            return false;
        value = v, where = at;
        return true;
    }
    bool empty() const { return value == -std::numeric_limits<double>::infinity(); }
};

/// A section as an offender.
Offender offender(const Groom& groom, std::size_t section, std::uint32_t frame);

/// What is always known of a criterion.
struct Question {
    const char* name;
    const char* meaning;
    const char* unit;
    double bound;
    Sense sense = Sense::at_most;
};
/// The question with its answer. A value that is no number fails.
Criterion answered(const Question& question, double value, std::optional<Offender> worst,
                   std::string note = {});
/// The question without an answer, and why.
Criterion unanswered(const Question& question, std::string why);
/// A figure that has no bound.
Criterion measured(const char* name, const char* meaning, const char* unit, double value,
                   std::string note);

} // namespace mane::judge
