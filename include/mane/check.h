#pragma once

/// The judge of a run (`mane check`): reads a cache as any other program would and measures what is
/// in it by means of its own. It shares no geometry with the solver.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mane {

class CacheReader;

/// What a run may do at most, or must reach at least. The defaults are the constants of the judge;
/// a scene's `[check]` may only tighten them, which the ranges of its fields see to.
struct CheckDesc {
    double strands_deep = 0.005;      ///< [1] share of strand vertices deep in a body, over the run
    double strands_deep_frame = 0.02; ///< [1] the same in any one frame
    double axis_through = 0.5;        ///< [s] that the axis of a segment stays in a body
    double stretch = 0.15;            ///< [1] of a segment over its rest length; straight styles
    double area = 0.7;                ///< [1] at least: of all sections, relative to the design
    double drawn_envelope = 0.02;     ///< [1] local radii that a strand leaves its wisp by
    double reach = 1.15;              ///< [1] lengths of the wisp from its root to its tip
    double rest_speed = 0.02;         ///< [m/s] from 3 s after the motion stopped
    double still_speed = 0.001;       ///< [m/s] from 6 s after the motion stopped
    double rest_jitter = 0.001;       ///< [m/s] above 10 Hz, from 3 s after the motion stopped
};

/// [m] A strand vertex is deep in a body when it is deeper than this (M33).
inline constexpr double kDeep = 0.002;

/// Where a criterion is met worst.
struct Offender {
    std::optional<std::uint32_t> wisp = {};
    std::optional<std::uint32_t> section = {}; ///< in its wisp, 0 is x₀
    std::optional<std::uint32_t> point = {};   ///< envelope point, where it is one
    std::uint32_t frame = 0;                   ///< in the file, from 0
};

enum class Verdict : std::uint8_t {
    pass,
    fail,
    not_judged, ///< the file holds nothing to judge by: `note` says why
};

/// Which side of its bound a value has to be on; the bound itself is right.
enum class Sense : std::uint8_t { at_most, at_least };

/// One thing that was measured.
struct Criterion {
    std::string name;    ///< for machines: stays the same from version to version
    std::string meaning; ///< for people
    std::string unit;    ///< of value and bound
    double value = std::numeric_limits<double>::quiet_NaN(); ///< NaN: not measured
    double bound = 0;
    Sense sense = Sense::at_most;
    Verdict verdict = Verdict::not_judged;
    std::optional<Offender> worst;
    std::string note;
};

struct CheckReport {
    std::vector<Criterion> criteria;
    bool passed() const; ///< no criterion fails
    /// The criterion of this name. Throws std::out_of_range.
    const Criterion& operator[](std::string_view name) const;
};

struct CheckOptions {
    std::uint32_t strands = 2000; ///< [1] drawn in each frame, to judge what shows
};

/// Judges a run from its stored frames. Throws InputError for a cache without frames, a damaged
/// one, or one whose scene cannot be read.
CheckReport check_run(const CacheReader& run, const CheckOptions& options = {});

/// What a frame amounts to over the whole head.
struct FrameFigures {
    double kinetic_energy = 0; ///< [J] of skeletons and envelopes
    double volume = 0;         ///< [m³] of all envelopes, from x₁ on
    double penetration = 0;    ///< [m] the deepest skeleton or envelope point in a body; 0: none is
    std::vector<double> wisp_kinetic_energy; ///< [J] per wisp
};

/// The figures of every frame, in order. Throws InputError as `check_run` does, and for numbers
/// that are not finite.
std::vector<FrameFigures> frame_figures(const CacheReader& run);

} // namespace mane
