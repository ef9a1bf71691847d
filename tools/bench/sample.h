#pragma once

#include <nlohmann/json.hpp>

#include <vector>

namespace mane::bench {

/// What was measured: numbers by name, in groups.
using Json = nlohmann::ordered_json;

/// The medians of all numbers that runs have in common by name; what is no number, and what only
/// the first run has (its quality), is the first one's.
Json median(const std::vector<Json>& runs);

} // namespace mane::bench
