#pragma once

#include "model/ablation.h"
#include "model/rest_rows.h"
#include "model/state.h"

#include <string>
#include <vector>

namespace mane {

/// Where the kinematic sections 0 and 1 of every wisp go during a detection block: cubic Hermite
/// curves between the block's ends. One row per packet.
struct RootMotion {
    enum Column : std::uint32_t { inside, outside, axis, count }; ///< x₀, x₁, u₀

    Rows value[2];     ///< at the block's beginning and end, three numbers per column
    Rows slope[2];     ///< derivatives by the block's time from 0 to 1
    float seconds = 0; ///< the block's length

    RootMotion() = default;
    explicit RootMotion(std::size_t packets);
};

/// Packets that one call of a kernel goes through at most: 10 to 30 µs of forces, well above the
/// cost of waking a thread. They share one scratch, which stays in the cache.
inline constexpr std::size_t kPacketsPerChunk = 8;

/// What one pass over a packet's sections hands on to the next ones: where it begins in a row of
/// scratch. A segment is in the row of the section before it.
struct Scratch {
    enum Column : std::uint32_t {
        // of the segment
        direction = 0,
        length = 3,
        inverse_length,
        tension,
        angular_velocity,
        // of the section
        half_cosine = angular_velocity + 3, ///< of half the bend
        half_secant,                        ///< ½ / half_cosine
        tilt,                               ///< of the normal
        half_chord = tilt + 2,              ///< half of what the direction changes by
        bending = half_chord + 2,           ///< moment
        twist = bending + 2,                ///< moment
        force,                              ///< of the skeleton's springs
        springs = force + 3,                ///< forces of the envelope's, one per point
        count = springs + kMaxEnvelopePoints
    };
};
/// Scratch for a layout's packets.
Rows force_scratch(const Layout& layout);

/// All that the kernels of one step read and write.
struct KernelData {
    const Layout& layout;
    const RestRows& rest;
    const RootMotion& roots;
    const std::vector<HalfLine>& half_lines;
    State& state;
    SectionFrames& frames;
    Rows& scratch;   ///< see `force_scratch`
    Rows& root_axis; ///< u₀ now, one row per packet
    const Rows*
        wind; ///< the air's velocity at each skeleton point; null: `uniform_wind` everywhere
    Vec3 uniform_wind;
    Vec3 gravity;
    float drag = 0;
    float step = 0;         ///< [s]
    Ablation ablation = {}; ///< of tests
};

/// The step's work on packets [first, last) of one chunk, compiled once per instruction set. All
/// give the same bits.
struct Kernels {
    const char* instruction_set;
    void (*section_frames)(const KernelData&, std::size_t first, std::size_t last);
    /// Stage 1 and the first half of stage 3 of §5.1: forces into velocities. Nothing reads
    /// velocities between the two.
    void (*process_forces)(const KernelData&, std::size_t first, std::size_t last);
    /// Velocities of the kinematic sections at the block's time `s` in [0, 1].
    void (*move_root_velocities)(const KernelData&, float s, std::size_t first, std::size_t last);
    /// Puts the kinematic sections to their place at `s`.
    void (*place_roots)(const KernelData&, float s, std::size_t first, std::size_t last);
    /// Stage 4: positions from velocities; the kinematic sections go to their place at `s`.
    void (*process_positions)(const KernelData&, float s, std::size_t first, std::size_t last);
};

/// The kernels of an instruction set by name (avx512, avx2, sse4, scalar, …), or of the machine's
/// best for "". Throws InputError for a set that this machine or build does not have.
Kernels kernels_for(const std::string& instruction_set);

} // namespace mane
