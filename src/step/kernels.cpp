#include "step/kernels.h"

#include "mane/error.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "step/kernels.cpp"
#include <hwy/foreach_target.h>

#include "step/forces-inl.h"
#include "step/positions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {
Kernels all_kernels() {
    return {hwy::TargetName(HWY_TARGET), section_frames, process_forces,
            move_root_velocities,        place_roots,    process_positions};
}
} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <mutex>

namespace mane {
namespace {

struct InstructionSet {
    const char* name;
    std::int64_t target;
};
constexpr InstructionSet kInstructionSets[] = {
    {"avx512", HWY_AVX3}, {"avx2", HWY_AVX2}, {"sse4", HWY_SSE4},
    {"neon", HWY_NEON},   {"wasm", HWY_WASM}, {"scalar", HWY_SCALAR},
};

std::string names_of(std::int64_t targets) {
    std::string list;
    for (const InstructionSet& set : kInstructionSets)
        if (set.target & targets)
            list += (list.empty() ? "" : ", ") + std::string(set.name);
    return list;
}

#if HWY_HAVE_RUNTIME_DISPATCH

HWY_EXPORT(all_kernels);

std::int64_t sets_here() {
    return (hwy::SupportedTargets() | HWY_STATIC_TARGET) & HWY_TARGETS;
}

Kernels kernels_of(std::int64_t target) {
    // Highway keeps one choice per process; it is borrowed here only to read the table of kernels.
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    hwy::GetChosenTarget().Update(target);
    const Kernels kernels = HWY_DYNAMIC_DISPATCH(all_kernels)();
    hwy::GetChosenTarget().DeInit();
    return kernels;
}

#else // one set, chosen when the page was built

std::int64_t sets_here() {
    return HWY_STATIC_TARGET;
}
Kernels kernels_of(std::int64_t) {
    return HWY_STATIC_DISPATCH(all_kernels)();
}

#endif

} // namespace

Kernels kernels_for(const std::string& instruction_set) {
    for (const InstructionSet& set : kInstructionSets) {
        if (!(set.target & sets_here()) ||
            (!instruction_set.empty() && instruction_set != set.name))
            continue;
        Kernels kernels = kernels_of(set.target);
        kernels.instruction_set = set.name;
        return kernels;
    }
    throw InputError("instruction set \"" + instruction_set +
                     "\" is not available here; this machine has " + names_of(sets_here()));
}

Rows curve_scratch(const Layout& layout) {
    constexpr std::uint32_t kNumbers = 7;
    const std::size_t chunks = (layout.packets().size() + kPacketsPerChunk - 1) / kPacketsPerChunk;
    return Rows(chunks * layout.most_rows(), kNumbers);
}

RootMotion::RootMotion(std::size_t packets) {
    for (int end : {0, 1})
        value[end] = slope[end] = Rows(packets, 3 * count);
}

} // namespace mane
#endif
