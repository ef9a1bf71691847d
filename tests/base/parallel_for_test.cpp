#include "base/parallel_for.h"

#include <doctest/doctest.h>

#include <stdexcept>
#include <vector>

using namespace mane;

TEST_CASE("every chunk runs once, for any number of threads and chunks") {
    for (unsigned threads : {1u, 2u, 5u}) {
        Threads pool(threads);
        CHECK(pool.count() == threads);
        for (std::size_t chunks : {0u, 1u, 2u, 7u, 1000u}) {
            std::vector<int> calls(chunks, 0);
            pool.run(chunks, [&](std::size_t c) { ++calls[c]; });
            for (int n : calls)
                CHECK(n == 1);
        }
    }
}

TEST_CASE("the lowest failing chunk's exception reaches the caller, and the pool goes on") {
    Threads pool(3);
    for (int round = 0; round < 20; ++round) {
        try {
            pool.run(64, [](std::size_t c) {
                if (c >= 5)
                    throw std::runtime_error(std::to_string(c));
            });
            FAIL("no exception");
        } catch (const std::runtime_error& e) {
            CHECK(std::string(e.what()) == "5");
        }
    }
    int sum = 0;
    pool.run(1, [&](std::size_t) { sum = 1; });
    CHECK(sum == 1);
}
