#pragma once

#include "mane/error.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace mane::test {

/// What `make` gives for the name of every instruction set that this machine has.
template <typename Make> auto on_all_sets(Make&& make) {
    std::vector<decltype(make(std::string()))> all;
    for (const char* name : {"avx512", "avx2", "sse4", "neon", "scalar"}) {
        try {
            all.push_back(make(name));
        } catch (const InputError&) {
            MESSAGE("skipped: no " << std::string(name) << " on this machine");
        }
    }
    return all;
}

} // namespace mane::test
