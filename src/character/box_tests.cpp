#include "character/box_tests.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

/// [m] over the rounding of double precision, near the origin too.
constexpr float kLeast = 1e-9f;

float size_of(const Vec3d& p) {
    return static_cast<float>(std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
}

} // namespace

BoxDistances::BoxDistances(const Vec3d& p) {
    const float slack = kBoxRounding * size_of(p) + kLeast;
    const std::array<float, 3> at{static_cast<float>(p.x), static_cast<float>(p.y),
                                  static_cast<float>(p.z)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        above[axis] = at[axis] + slack;
        below[axis] = at[axis] - slack;
    }
}

// What is compared is within the box: it rounds by less than a millionth of its farthest corner's
// size along the way.
BoxHeights::BoxHeights(const Vec3& way, const TriangleTree::Box& box)
    : along(way), low{box.low.x, box.low.y, box.low.z}, high{box.high.x, box.high.y, box.high.z} {
    const std::array<float, 3> ways{way.x, way.y, way.z};
    float size = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        size += std::abs(ways[i]) * std::max(std::abs(low[i]), std::abs(high[i]));
        up[i] = std::max(ways[i], 0.0f);
        down[i] = std::min(ways[i], 0.0f);
    }
    slack = kBoxRounding * size;
}

// Rounding moves what is compared by less than a millionth of the origin's and of the part's size.
// Coordinates of a box that are many times larger than the part round by more, but leave no doubt.
BoxCrossings::BoxCrossings(const Vec3d& from, const Vec3d& direction, double end) {
    const std::array<double, 3> start{from.x, from.y, from.z},
        way{direction.x, direction.y, direction.z};
    const std::array<double, 3> size{std::abs(way[0]), std::abs(way[1]), std::abs(way[2])};
    const auto largest =
        static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    axis = {(largest + 1) % 3, (largest + 2) % 3, largest};
    for (std::size_t i = 0; i < 3; ++i)
        origin[i] = static_cast<float>(start[axis[i]]);
    for (std::size_t i = 0; i < 2; ++i)
        shear[i] = static_cast<float>(way[axis[i]] / way[largest]);
    const auto tip = static_cast<float>(way[largest] * end);
    slack = kBoxRounding * (size_of(from) + std::abs(tip)) + kLeast;
    first = std::min(0.0f, tip);
    last = std::max(0.0f, tip);
}

} // namespace mane
