#include "base/instruction_set.h"

#include "mane/error.h"

#include <hwy/highway.h>
#include <hwy/targets.h>
#include <mutex>

namespace mane {
namespace {

constexpr InstructionSet kSets[] = {
    {"avx512", HWY_AVX3}, {"avx2", HWY_AVX2}, {"sse4", HWY_SSE4},
    {"neon", HWY_NEON},   {"wasm", HWY_WASM}, {"scalar", HWY_SCALAR},
};

// One set, chosen when the program was built, or those of the build that the machine has.
std::int64_t sets_here() {
#if HWY_HAVE_RUNTIME_DISPATCH
    return (hwy::SupportedTargets() | HWY_STATIC_TARGET) & HWY_TARGETS;
#else
    return HWY_STATIC_TARGET;
#endif
}

std::string list_of(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names)
        list += (list.empty() ? "" : ", ") + name;
    return list;
}

std::mutex& choice() {
    static std::mutex mutex;
    return mutex;
}

} // namespace

InstructionSet instruction_set(const std::string& name) {
    for (const InstructionSet& set : kSets)
        if ((set.target & sets_here()) && (name.empty() || name == set.name))
            return set;
    throw InputError("instruction set \"" + name + "\" is not available here; this machine has " +
                     list_of(instruction_sets()));
}

std::vector<std::string> instruction_sets() {
    std::vector<std::string> names;
    for (const InstructionSet& set : kSets)
        if (set.target & sets_here())
            names.push_back(set.name);
    return names;
}

ChosenInstructionSet::ChosenInstructionSet(const InstructionSet& set) {
    choice().lock();
#if HWY_HAVE_RUNTIME_DISPATCH
    hwy::GetChosenTarget().Update(set.target);
#else
    static_cast<void>(set);
#endif
}
ChosenInstructionSet::~ChosenInstructionSet() {
#if HWY_HAVE_RUNTIME_DISPATCH
    hwy::GetChosenTarget().DeInit();
#endif
    choice().unlock();
}

} // namespace mane
