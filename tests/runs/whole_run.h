#pragma once

#include "mane/cache.h"
#include "mane/check.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>

/// What `mane check` says of `mane simulate` with the scene of a style and some more options.
/// `strands` are drawn: strands stay inside their wisps, which are judged whole.
inline mane::CheckReport simulate_and_check(const std::string& style, const std::string& options,
                                            std::uint32_t strands) {
    namespace fs = std::filesystem;
    const fs::path file = fs::temp_directory_path() /
                          ("mane_run_" + std::to_string(std::random_device{}()) + ".mane");
    const std::string command = "'" MANE_COMMAND "' simulate '" MANE_SOURCE_DIR "/scenes/" + style +
                                ".toml' " + options + " -o '" + file.string() + "' >/dev/null";
    REQUIRE(std::system(command.c_str()) == 0);
    mane::CheckReport report = mane::check_run(mane::CacheReader(file), {.strands = strands});
    fs::remove(file);
    return report;
}
