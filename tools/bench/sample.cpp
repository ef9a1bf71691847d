#include "bench/sample.h"

#include <algorithm>

namespace mane::bench {
namespace {

double median_of(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return n % 2 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

/// The members of this name.
std::vector<Json> members(const std::vector<Json>& runs, const std::string& name) {
    std::vector<Json> found;
    for (const Json& run : runs)
        if (run.contains(name))
            found.push_back(run[name]);
    return found;
}

} // namespace

Json median(const std::vector<Json>& runs) {
    const Json& first = runs.front();
    if (first.is_object()) {
        Json all = Json::object();
        for (const auto& item : first.items())
            all[item.key()] = median(members(runs, item.key()));
        return all;
    }
    if (!first.is_number_float())
        return first;
    std::vector<double> values;
    values.reserve(runs.size());
    for (const Json& run : runs)
        values.push_back(run.get<double>());
    return median_of(std::move(values));
}

} // namespace mane::bench
