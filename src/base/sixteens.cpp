#include "base/sixteens.h"

#include "base/four.h"

#include <algorithm>

namespace mane {
namespace {

constexpr std::size_t kNode = 16;

float Vec3::*longest_side(std::span<const Vec3> places, std::span<const std::uint32_t> numbers) {
    Four low = four(places[numbers[0]]), high = low;
    for (const std::uint32_t i : numbers) {
        low = smaller(low, four(places[i]));
        high = larger(high, four(places[i]));
    }
    const Vec3 size = first_three(high - low);
    if (size.x >= size.y && size.x >= size.z)
        return &Vec3::x;
    return size.y >= size.z ? &Vec3::y : &Vec3::z;
}

/// Of about half, whole nodes.
std::size_t first_half(std::size_t count) {
    std::size_t part = kNode;
    while (part * kNode < count)
        part *= kNode;
    return (count + part - 1) / part / 2 * part;
}

} // namespace

void order_by_sixteens(std::span<const Vec3> places, std::span<std::uint32_t> numbers) {
    if (numbers.size() <= kNode) {
        std::sort(numbers.begin(), numbers.end());
        return;
    }
    float Vec3::*const axis = longest_side(places, numbers);
    const std::size_t half = first_half(numbers.size());
    std::nth_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(half),
                     numbers.end(), [&](std::uint32_t a, std::uint32_t b) {
                         const float at_a = places[a].*axis, at_b = places[b].*axis;
                         return at_a != at_b ? at_a < at_b : a < b;
                     });
    order_by_sixteens(places, numbers.first(half));
    order_by_sixteens(places, numbers.subspan(half));
}

} // namespace mane
