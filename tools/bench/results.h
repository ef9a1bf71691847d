#pragma once

#include "bench/cases.h"
#include "bench/sample.h"

#include <filesystem>
#include <string>
#include <vector>

namespace mane::bench {

/// A case with all its runs, and what counts of them.
struct Result {
    Case what;
    std::vector<Json> runs;
    Json medians;
};

/// On what, by what and when.
struct Circumstances {
    std::string version, date, processor, instruction_set;
    unsigned hardware_threads = 1;
    std::uint32_t runs = 0;
};
Circumstances circumstances(std::uint32_t runs);

/// The tables for people: times beside quality, each stage against what binds it, ratios.
std::string to_tables(const Circumstances& where, const std::vector<Result>& results);
/// All of it, every single run included.
std::string to_json(const Circumstances& where, const std::vector<Result>& results);
/// One file per group in `folder`: a line that says where and when, the names of the columns, and
/// the medians of a case per line. Throws InputError when it cannot be written.
void write_csv(const Circumstances& where, const std::vector<Result>& results,
               const std::filesystem::path& folder);

} // namespace mane::bench
