#include "bench/machine_kernels.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/machine_kernels.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::bench::HWY_NAMESPACE {

using mane::HWY_NAMESPACE::kPackLanes;
using mane::HWY_NAMESPACE::Pack;
namespace hn = hwy::HWY_NAMESPACE;

// Named one by one: an array of twelve would be kept in memory.
template <typename Operation> HWY_INLINE float chains(std::size_t rounds, const Operation& next) {
    Pack a(0.1f), b(0.2f), c(0.3f), d(0.4f), e(0.5f), f(0.6f), g(0.7f), h(0.8f), i(0.9f), j(1.0f),
        k(1.1f), l(1.2f);
    for (std::size_t n = 0; n < rounds; ++n) {
        a = next(a), b = next(b), c = next(c), d = next(d), e = next(e), f = next(f);
        g = next(g), h = next(h), i = next(i), j = next(j), k = next(k), l = next(l);
    }
    const Pack sum = ((a + b) + (c + d)) + ((e + f) + (g + h)) + ((i + j) + (k + l));
    return hn::GetLane(sum.v);
}

float multiply(std::size_t rounds, float factor, float) {
    const Pack by(factor);
    return chains(rounds, [by](Pack x) HWY_ATTR { return x * by; });
}
float add(std::size_t rounds, float, float term) {
    const Pack more(term);
    return chains(rounds, [more](Pack x) HWY_ATTR { return x + more; });
}
float multiply_add(std::size_t rounds, float factor, float term) {
    const Pack by(factor), more(term);
    return chains(rounds, [by, more](Pack x) HWY_ATTR { return by * x + more; });
}
float fused(std::size_t rounds, float factor, float term) {
    const Pack by(factor), more(term);
    return chains(rounds,
                  [by, more](Pack x) HWY_ATTR { return Pack(hn::MulAdd(by.v, x.v, more.v)); });
}

void triad(float* a, const float* b, const float* c, float factor, std::size_t count) {
    const Pack by(factor);
    for (std::size_t i = 0; i < count; i += kPackLanes)
        (Pack::load(b + i) + by * Pack::load(c + i)).store(a + i);
}

MachineKernels all_kernels() {
    return {multiply, add, multiply_add, fused, kPackLanes, triad};
}

} // namespace mane::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane::bench {

HWY_EXPORT(all_kernels);

MachineKernels machine_kernels(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(all_kernels)();
}

} // namespace mane::bench
#endif
