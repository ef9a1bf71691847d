#include "mane/fields.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace mane {
namespace {

// Levenshtein's distance, with two letters swapped as one edit: the commonest slip.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before = std::exchange(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({last[j - 1] + (a[i - 1] != b[j - 1]), last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
    }
    return row.back();
}

bool similar(std::size_t distance, std::string_view name) {
    return distance <= std::max<std::size_t>(1, name.size() / 3);
}

/// The first of `items` with the smallest `distance`.
template <typename Items, typename Distance>
auto nearest(const Items& items, const Distance& distance) {
    return std::min_element(items.begin(), items.end(), [&](const auto& a, const auto& b) {
        return distance(a) < distance(b);
    });
}

} // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> names) {
    const auto distance = [&](const std::string& n) { return edit_distance(name, n); };
    const auto best = nearest(names, distance);
    return best != names.end() && similar(distance(*best), name) ? *best : std::string();
}

std::string suggestion(std::string_view section, std::string_view name) {
    // The right name in another section is as good a guess as one wrong letter in this one.
    const FieldInfo& best = **nearest(all_fields(), [&](const FieldInfo* f) {
        return 2 * edit_distance(name, f->name) + (f->section != section);
    });
    if (similar(edit_distance(name, best.name), name))
        return " (did you mean " + best.key() + "?)";
    std::string known;
    for (const FieldInfo* f : all_fields())
        if (f->section == section)
            known += (known.empty() ? "" : ", ") + std::string(f->name);
    return " (known: " + known + ")";
}

} // namespace mane
