// The lanes of a mask come one after the other, for every mask and instruction set.

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "base/packing_test.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// Packs the numbers whose bits are set, vector by vector.
std::size_t pack_sixteen(std::uint32_t bits, const float* from, float* to,
                         std::uint32_t* whole_to) {
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < 16; lane += kPackLanes) {
        const Packing packing(mask_of(bits >> lane));
        const Pack numbers = Pack::load(from + lane);
        packing.store(numbers, to + count);
        const Numbers whole = hn::BitCast(Numbers::D(), hn::ConvertTo(Whole(), numbers.v));
        packing.store(whole, whole_to + count);
        count += packing.count();
    }
    return count;
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"
#include "instruction_sets.h"

#include <vector>

namespace mane {

HWY_EXPORT(pack_sixteen);

/// Of all masks, those whose lanes come out otherwise than one by one.
std::size_t wrongly_packed(const InstructionSet& set) {
    const ChosenInstructionSet chosen(set);
    alignas(64) float from[16], to[32];
    std::uint32_t whole_to[32];
    for (int i = 0; i < 16; ++i)
        from[i] = static_cast<float>(i + 1);
    std::size_t wrong = 0;
    for (std::uint32_t bits = 0; bits < 1u << 16; ++bits) {
        std::vector<float> expected;
        for (std::uint32_t i = 0; i < 16; ++i)
            if ((bits >> i & 1) != 0)
                expected.push_back(from[i]);
        const std::size_t count = HWY_DYNAMIC_DISPATCH(pack_sixteen)(bits, from, to, whole_to);
        wrong += std::vector<float>(to, to + count) != expected ||
                 std::vector<float>(whole_to, whole_to + count) != expected;
    }
    return wrong;
}

TEST_CASE("the lanes of a mask come one after the other, for every mask and instruction set") {
    for (const std::size_t wrong : test::on_all_sets(
             [](const std::string& name) { return wrongly_packed(instruction_set(name)); }))
        CHECK(wrong == 0);
}

} // namespace mane
#endif
