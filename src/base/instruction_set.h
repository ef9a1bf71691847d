#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mane {

/// An instruction set that this build has and this machine can run: Highway's number for it.
struct InstructionSet {
    const char* name;
    std::int64_t target;
};

/// The set with the name (avx512, avx2, sse4, neon, wasm, scalar), or the best for "". Throws
/// InputError for one that this machine or build does not have.
InstructionSet instruction_set(const std::string& name);
/// The names of all that this build has and this machine can run, the best first.
std::vector<std::string> instruction_sets();

/// While it lives, Highway's dynamic dispatch chooses `set`. Highway keeps one choice per process;
/// it is borrowed here only to read a table of kernels, one caller at a time.
class ChosenInstructionSet {
  public:
    explicit ChosenInstructionSet(const InstructionSet& set);
    ~ChosenInstructionSet();
    ChosenInstructionSet(const ChosenInstructionSet&) = delete;
    ChosenInstructionSet& operator=(const ChosenInstructionSet&) = delete;
};

} // namespace mane
