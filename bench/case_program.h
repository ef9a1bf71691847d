#pragma once

/// What a program does that `mane bench` starts for a case: `PROGRAM bench-one CASE`. The case
/// comes as JSON; what it took, or what was wrong with it, goes out as JSON.

#include "mane/error.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace mane {

/// The exit code: 2 for bad input, 1 for any other failure.
template <typename Measure> int run_case(int argc, char** argv, Measure&& measure) {
    using Json = nlohmann::ordered_json;
    if (argc != 3)
        return std::fprintf(stderr, "usage: %s bench-one CASE\n", argv[0]), 2;
    try {
        std::printf("%s\n", measure(Json::parse(argv[2])).dump().c_str());
        return 0;
    } catch (const std::exception& error) {
        std::printf("%s\n", Json(error.what()).dump().c_str());
        return dynamic_cast<const InputError*>(&error) ? 2 : 1;
    }
}

} // namespace mane
