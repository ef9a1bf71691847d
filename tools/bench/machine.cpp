#include "bench/machine_kernels.h"
#include "bench/measure.h"

#include "base/aligned.h"
#include "base/instruction_set.h"

#include <algorithm>
#include <functional>
#include <string>
#include <thread>

namespace mane::bench {
namespace {

constexpr double kSeconds = 0.01; // that one try takes at least
constexpr int kTries = 5;         // a peak is the best of several
volatile float sink;              // keeps results alive

/// How often per second `work(n, thread)` does what it does once for n = 1: the best of several
/// tries, each with `threads` threads at once.
double rate(const std::function<void(std::size_t, unsigned)>& work, unsigned threads) {
    const auto seconds = [&](std::size_t n) {
        Watch watch;
        watch.go();
        {
            std::vector<std::jthread> others;
            for (unsigned t = 1; t < threads; ++t)
                others.emplace_back([&, n, t] { work(n, t); });
            work(n, 0);
        }
        watch.hold();
        return watch.wall();
    };
    std::size_t n = 1;
    while (seconds(n) < kSeconds)
        n *= 2;
    double best = 0;
    for (int i = 0; i < kTries; ++i)
        best = std::max(best, static_cast<double>(n * threads) / seconds(n));
    return best;
}

/// Billions of floating-point operations a second of a loop of chains.
double gflops(MachineKernels::Chains chains, double operations, std::size_t lanes,
              unsigned threads) {
    constexpr std::size_t kRounds = 1024;
    // Neither infinities nor denormals: 0.75 x + 0.25 goes to 1, and one operation alone changes
    // nothing.
    const bool both = operations > 1;
    const float factor = both ? 0.75f : 1.f, term = both ? 0.25f : 0.f;
    const auto work = [&](std::size_t n, unsigned) {
        for (std::size_t i = 0; i < n; ++i)
            sink = chains(kRounds, factor, term);
    };
    return 1e-9 * rate(work, threads) * static_cast<double>(kRounds * kChains * lanes) * operations;
}

Json arithmetic(const MachineKernels& kernels, unsigned threads) {
    const auto of = [&](MachineKernels::Chains chains, double operations) {
        return gflops(chains, operations, kernels.lanes, threads);
    };
    return {{"multiply", of(kernels.multiply, 1)},
            {"add", of(kernels.add, 1)},
            {"multiply_add", of(kernels.multiply_add, 2)},
            {"fused", of(kernels.fused, 2)}};
}

/// GB/s of a ← b + factor c, as STREAM counts them: two arrays are read and one is written. All
/// three have `megabytes` in all, in each thread.
double triad(const MachineKernels& kernels, double megabytes, unsigned threads) {
    struct Arrays {
        AlignedVector<float> a, b, c;
    };
    const std::size_t count = static_cast<std::size_t>(megabytes * 1e6 / 12) / 1024 * 1024;
    const AlignedVector<float> some(count, 1.f);
    std::vector<Arrays> arrays(threads, {some, some, some});
    const auto work = [&](std::size_t n, unsigned thread) {
        Arrays& own = arrays[thread];
        for (std::size_t i = 0; i < n; ++i)
            kernels.triad(own.a.data(), own.b.data(), own.c.data(), 0.5f, count);
    };
    return 1e-9 * rate(work, threads) * static_cast<double>(count) * 3 * sizeof(float);
}
Json triads(const MachineKernels& kernels, unsigned threads) {
    // A packet of wisps is worked on in the second level of the cache; ten thousand wisps are in
    // the third, if it is large. Where the system has one larger than the first figure here, that
    // figure is this cache's.
    constexpr double kFarMegabytes = 600, kNearMegabytes = 0.6;
    return {{"memory", triad(kernels, kFarMegabytes / threads, threads)},
            {"cache", triad(kernels, kNearMegabytes, threads)}};
}

} // namespace

Json measure_machine(const Case& c) {
    Json one = Json::object(), all = Json::object();
    for (const std::string& set : instruction_sets()) {
        const MachineKernels kernels = machine_kernels(set);
        one[set] = arithmetic(kernels, 1);
        all[set] = arithmetic(kernels, c.threads);
    }
    const MachineKernels best = machine_kernels("");
    return {{"threads", c.threads},
            {"gflops", one},
            {"gflops_all_threads", all},
            {"triad_gb_per_second", triads(best, 1)},
            {"triad_gb_per_second_all_threads", triads(best, c.threads)},
            {"peak_mb", peak_megabytes()}};
}

} // namespace mane::bench
