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

/// Packets that one call of a kernel goes through at most: about 50 µs of forces, well above the
/// cost of waking a thread. They share one scratch for their curves, which stays in the cache.
inline constexpr std::size_t kPacketsPerChunk = 8;
/// Scratch for the curves of a layout's packets.
Rows curve_scratch(const Layout& layout);

/// All that the kernels of one step read and write.
struct KernelData {
    const Layout& layout;
    const RestRows& rest;
    const RootMotion& roots;
    const std::vector<HalfLine>& half_lines;
    State& state;
    SectionFrames& frames;
    Rows& curve;     ///< scratch: see `curve_scratch`
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
