#include "reference/random_contacts.h"

#include "reference/random_numbers.h"

namespace mane::reference {
namespace {

template <typename T> const T& any_of(const std::vector<T>& values, RandomNumbers& random) {
    return values[random.count(0, static_cast<std::uint32_t>(values.size() - 1))];
}

/// Whether the point's own section, or for an axis either end, is one of the segment's.
bool touches_itself(const Contact& c) {
    const std::size_t last = c.point.section + (c.k == Contact::kAxis ? 1 : 0);
    return c.point.wisp == c.segment.wisp && last >= c.segment.section &&
           c.point.section <= c.segment.section + 1;
}

} // namespace

std::vector<Contact> random_contacts(const Hair& hair, std::size_t count, std::uint64_t seed) {
    std::vector<Site> sections, segments;
    for (std::size_t w = 0; w < hair.wisps.size(); ++w)
        for (std::size_t i = 1; i < hair.wisps[w].sections(); ++i) {
            sections.push_back({w, i});
            if (i + 1 < hair.wisps[w].sections())
                segments.push_back({w, i});
        }
    RandomNumbers random(seed);
    std::vector<Contact> contacts;
    for (std::size_t tries = 0; contacts.size() < count && tries < 100 * count; ++tries) {
        if (segments.empty())
            break;
        Contact c;
        const bool axis = random.chance(0.1);
        c.point = any_of(axis ? segments : sections, random);
        const std::uint32_t points = static_cast<std::uint32_t>(hair.wisps[c.point.wisp].points());
        c.k = axis ? Contact::kAxis : static_cast<int>(random.count(0, points)) - 1;
        c.along = axis ? random.between(0, 1) : 0;
        c.segment = any_of(segments, random);
        c.s = random.between(0, 1);
        c.friction = random.chance(0.5);
        c.density = random.around(0.2, 8);
        c.weight = random.chance(0.5) ? 1 : random.between(0.01, 1);
        if (!touches_itself(c))
            contacts.push_back(c);
    }
    return contacts;
}

} // namespace mane::reference
