#pragma once

namespace mane::bench {

/// What a stage does for a row of sixteen cross-sections in a step, however long it takes: to hold
/// its time against the machine's peaks. For four envelope points and a thickness power of 2.
struct StageWork {
    double operations; ///< [1] floating-point
    double bytes;      ///< [B] that cannot stay in registers or the first level of the cache
};

/// Arithmetic instructions in the passes of `PacketForces<4, true>`, as they are compiled for
/// AVX-512 (+ − × ÷ √, comparisons, larger, smaller; no moves and no bit operations): directions
/// 24, stretch 24, normals 24, axes 49, springs 108, bending 75, skeleton forces 82, velocities 74.
/// Bytes: position, velocity, radii and rates, and 23 columns of rest data are read; velocity,
/// rates and frames are written.
inline constexpr StageWork kForces{16.0 * (24 + 24 + 24 + 49 + 108 + 75 + 82 + 74),
                                   64.0 * ((3 + 3 + 4 + 4) + 23 + (3 + 4 + 9))};

/// `advance_section`: a product and a sum for each of seven numbers, and four comparisons.
/// Position, velocity, radii and rates are read; position and radii are written.
inline constexpr StageWork kPositions{16.0 * (7 * 2 + 4), 64.0 * ((3 + 3 + 4 + 4) + (3 + 4))};

} // namespace mane::bench
