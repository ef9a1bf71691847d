/// A step between two detections allocates nothing, with pins and without.

#include "step/live_hair.h"

#include <doctest/doctest.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};
}

// All of the program's; only the difference over a step counts.
void* operator new(std::size_t size) {
    ++allocations;
    if (void* memory = std::malloc(size ? size : 1))
        return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

using namespace mane;

TEST_CASE("a step between two detections allocates nothing") {
    bool counts = false; // not in a block's first step, where contacts are prepared
    long before = 0, found = 0, steps = 0;
    RunOptions options;
    options.on_stage = [&](const StageSpan& span) {
        const long now = allocations;
        const bool detects =
            span.stage == Stage::wisp_detection || span.stage == Stage::character_detection;
        if (detects)
            counts = false;
        else if (counts)
            found += now - before;
        if (span.stage == Stage::positions) {
            steps += counts;
            counts = true;
        }
        before = allocations;
    };
    World world = LiveHair::get().world(shake_motion(0.5, 2), options);
    advance(world, 4);
    for (std::uint32_t w : {2u, 9u, 17u})
        world.pin({.section = world.groom().first_section[w] + 4});
    advance(world, 6);
    CHECK(steps > 300);
    CHECK(found == 0);
    CHECK(allocations > 1000); // they are counted
}
