#include "step/kernels.h"

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
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(all_kernels);

Kernels kernels_for(const std::string& name) {
    const InstructionSet set = instruction_set(name);
    const ChosenInstructionSet chosen(set);
    Kernels kernels = HWY_DYNAMIC_DISPATCH(all_kernels)();
    kernels.instruction_set = set.name;
    return kernels;
}

Rows force_scratch(const Layout& layout) {
    const std::size_t chunks = (layout.packets().size() + kPacketsPerChunk - 1) / kPacketsPerChunk;
    return Rows(chunks * layout.most_rows(), Scratch::count);
}

RootMotion::RootMotion(std::size_t packets) {
    for (int end : {0, 1})
        value[end] = slope[end] = Rows(packets, 3 * count);
}

} // namespace mane
#endif
