#pragma once

/// What a user sets. Conventions of every file here: SI units, the unit in brackets in each
/// comment; right-handed axes, Y up, the character faces +Z; "ratio" and "share" are pure numbers
/// [1]. Ranges and help texts: `mane/fields.h`.

#include "mane/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mane {

// One parameter a line, with its unit and meaning: tables, which a formatter would fold.
// clang-format off

/// A value that changes linearly along a wisp.
struct Ramp {
    float root = 0;
    float tip = 0;
    constexpr Ramp() = default;
    constexpr Ramp(float both) : root(both), tip(both) {}
    constexpr Ramp(float root_, float tip_) : root(root_), tip(tip_) {}
    /// The value at `s`, 0 at the root and 1 at the tip.
    constexpr float at(float s) const { return root + (tip - root) * s; }
    constexpr bool operator==(const Ramp&) const = default;
};

/// Layer 1, the skeleton (§3.2).
struct SkeletonDesc {
    float strand_mass = 5e-6f;    ///< [kg/m] mass of one strand per length; a wisp has this times its strands
    float strain = 0.005f;        ///< [1] stretch of the root segment when the wisp hangs under its own weight
    float stretch_damping = 0.05f; ///< [1] damping ratio of one segment's spring
    float bending_length = 0.06f; ///< [m] (EI/λg)^⅓: how far a wisp stands out before it hangs
    float bending_damping = 0.3f; ///< [1] damping ratio of the first bending mode of one bending length
    float thickness_power = 2;    ///< [1] bending stiffness grows with the wisp's radius to this power
};

/// Layer 2, the envelope (§3.3).
struct EnvelopeDesc {
    std::uint32_t points = 4;   ///< [1] envelope points per cross-section
    float mass_share = 0.2f;    ///< [1] share of a section's mass that its envelope points carry
    float squeeze = 0.2f;       ///< [1] loss of radius under the section's own weight
    Ramp stiffness = {1, 0.25f}; ///< [1] radial stiffness along the wisp, relative to what `squeeze` asks
    float damping = 1;          ///< [1] damping ratio of the radial springs
    float ring_stiffness = 0.3f; ///< [1] springs between neighbouring envelope points, relative to the radial ones
    float ring_damping = 2;     ///< [1] damping ratio of the ring springs
};

/// The air (M38).
struct AirDesc {
    float drag = 3;             ///< [1/s] air resistance: deceleration per velocity relative to the air
    Vec3 wind = {};             ///< [m/s] the air's mean velocity
    float gusts = 0;            ///< [m/s] standard deviation of the turbulence around it, per axis
    float gust_size = 0.5f;     ///< [m] size of the largest eddies
    std::uint32_t gust_seed = 1; ///< [1] another number, other gusts
};

/// How wisps answer each other (§4.1).
enum class WispContactMode : std::uint8_t {
    off,         ///< wisps pass through each other
    isotropic,   ///< every contact is a dissipative collision
    anisotropic, ///< as in the paper: quasi-parallel wisps slide, the others collide
};

/// Interactions between wisps (§4.1).
struct WispContactDesc {
    WispContactMode mode = WispContactMode::anisotropic; ///< how wisps answer each other
    float parallel_angle = 30;    ///< [deg] wisps closer in direction than this may slide into each other
    float fade_angle = 10;        ///< [deg] under this angle the plane of two wisps fades out (M24)
    float sliding_speed = 0.02f;  ///< [m/s] relative velocity out of the plane that still counts as sliding
    float hysteresis = 1.2f;      ///< [1] factor on both limits before a sliding contact becomes a collision
    float friction = 10;          ///< [1/s] drag between sliding wisps at rest density
    float axis_contact_ratio = 1.5f; ///< [1] segments longer than this many diameters also collide axis to axis
    bool literal = false;         ///< the paper's bare ½ for every point, for study: energy may grow
};

/// Contact with the character and obstacles (§4.2).
struct CharacterContactDesc {
    float threshold = 0.004f; ///< [m] sliding contact starts at this distance from the surface
    float push_out = 0.0035f; ///< [m] distance to which a skeleton point that went inside is moved out
    float friction = 5;       ///< [1/s] viscous drag on skin
};

/// How often each part of the step runs (§5.3, M36). Rates are rounded up to whole counts per frame.
struct ScheduleDesc {
    float frame_rate = 24;         ///< [Hz] stored frames
    std::uint32_t frames = 264;    ///< [1] frames to simulate
    float preroll = 1;             ///< [s] motion before the first frame
    float integration_rate = 1000; ///< [Hz] explicit integration steps
    float character_rate = 120;    ///< [Hz] detection of contacts with the character
    float wisp_rate = 120;         ///< [Hz] detection of contacts between wisps
    bool hold_contacts = true;     ///< contacts stay engaged between detections; false: answered only when found
};

/// How strands are spread over a wisp's cross-section (§5.2).
enum class StrandDistribution : std::uint8_t { uniform, gaussian, rim };

/// Layer 3, the strands (§3.4, §5.2).
struct StrandDesc {
    std::uint32_t count = 100000; ///< [1] strands on the whole head
    StrandDistribution distribution = StrandDistribution::uniform; ///< where they stand in a cross-section
    float jitter = 0.15f;         ///< [1] largest share by which a control point moves toward the skeleton
    float length_jitter = 0.1f;   ///< [1] largest share by which a strand is shortened
    float waves = 0;              ///< [1] waves along a strand
    float wave_amplitude = 0;     ///< [1] amplitude at rest, relative to the wisp's radius
    float curls = 0;              ///< [1] turns that the strands of a wisp make inside it, from x₁ to its tip
    float root_width = 80e-6f;    ///< [m] a strand's diameter at the root
    float tip_width = 30e-6f;     ///< [m] a strand's diameter at the tip
};

/// Everything that the step reads, whatever the style, the character and its motion.
struct SimulationDesc {
    std::uint32_t seed = 1;     ///< [1] another number, other random choices everywhere
    Vec3 gravity = {0, -9.81f, 0}; ///< [m/s²]
    AirDesc air;
    WispContactDesc wisps;
    CharacterContactDesc character;
    ScheduleDesc schedule;
};

// clang-format on

} // namespace mane
