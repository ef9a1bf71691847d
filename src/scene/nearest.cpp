#include "mane/fields.h"

#include <algorithm>
#include <numeric>

namespace mane {
namespace {

// Levenshtein's distance, row by row.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

bool similar(std::size_t distance, std::string_view name) {
    return distance <= std::max<std::size_t>(1, name.size() / 3);
}

} // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> names) {
    const auto best = std::ranges::min_element(
        names, {}, [&](const std::string& n) { return edit_distance(name, n); });
    return best != names.end() && similar(edit_distance(name, *best), name) ? *best : std::string();
}

std::string suggestion(std::string_view section, std::string_view name) {
    // The right name in another section is as good a guess as one wrong letter in this one.
    const auto distance = [&](const Field& f) {
        return 2 * edit_distance(name, f.name) + (f.section != section);
    };
    const auto best = std::ranges::min_element(scene_fields(), {}, distance);
    if (similar(edit_distance(name, best->name), name))
        return " (did you mean " + best->key() + "?)";
    std::string known;
    for (const Field& f : scene_fields())
        if (f.section == section)
            known += (known.empty() ? "" : ", ") + std::string(f.name);
    return " (known: " + known + ")";
}

} // namespace mane
