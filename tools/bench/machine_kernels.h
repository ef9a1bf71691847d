#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mane::bench {

/// Loops that do one thing as fast as an instruction set can, over the vectors that the
/// simulation's kernels are written in (`base/pack-inl.h`).
struct MachineKernels {
    /// Twelve independent chains, so that no operation waits for another. They return a number
    /// that depends on all of it.
    using Chains = float (*)(std::size_t rounds, float factor, float term);
    Chains multiply;     ///< x ← factor x
    Chains add;          ///< x ← x + term
    Chains multiply_add; ///< x ← factor x + term, rounded twice, as everywhere in mane
    Chains fused;        ///< the same, rounded once, where there is such an instruction
    std::size_t lanes;   ///< floats in a vector
    /// a ← b + factor c; all of a multiple of 16 floats, aligned to 64 bytes.
    void (*triad)(float* a, const float* b, const float* c, float factor, std::size_t count);
};
inline constexpr std::size_t kChains = 12;

MachineKernels machine_kernels(const std::string& instruction_set);

} // namespace mane::bench
