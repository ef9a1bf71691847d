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
        above_[axis] = Four{} + (at[axis] + slack);
        below_[axis] = Four{} + (at[axis] - slack);
    }
}

// What is compared is within the box: it rounds by less than a millionth of its farthest corner's
// size along the way.
BoxHeights::BoxHeights(const Vec3& way, const TriangleTree::Box& box) : along_(way) {
    const std::array<float, 3> ways{way.x, way.y, way.z}, low{box.low.x, box.low.y, box.low.z},
        high{box.high.x, box.high.y, box.high.z};
    float size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        size += std::abs(ways[axis]) * std::max(std::abs(low[axis]), std::abs(high[axis]));
        up_[axis] = Four{} + std::max(ways[axis], 0.0f);
        down_[axis] = Four{} + std::min(ways[axis], 0.0f);
        low_[axis] = Four{} + low[axis];
        high_[axis] = Four{} + high[axis];
    }
    slack_ = kBoxRounding * size;
}

// Rounding moves what is compared by less than a millionth of the origin's and of the part's size.
// Coordinates of a box that are many times larger than the part round by more, but leave no doubt.
BoxCrossings::BoxCrossings(const Vec3d& origin, const Vec3d& direction, double end) {
    const std::array<double, 3> from{origin.x, origin.y, origin.z},
        way{direction.x, direction.y, direction.z};
    const std::array<double, 3> size{std::abs(way[0]), std::abs(way[1]), std::abs(way[2])};
    const auto largest =
        static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
    axis_ = {(largest + 1) % 3, (largest + 2) % 3, largest};
    for (std::size_t i = 0; i < 3; ++i)
        origin_[i] = static_cast<float>(from[axis_[i]]);
    for (std::size_t i = 0; i < 2; ++i)
        shear_[i] = static_cast<float>(way[axis_[i]] / way[largest]);
    const auto tip = static_cast<float>(way[largest] * end);
    slack_ = kBoxRounding * (size_of(origin) + std::abs(tip)) + kLeast;
    first_ = std::min(0.0f, tip);
    last_ = std::max(0.0f, tip);
}

Four BoxCrossings::apart(const TriangleTree::Node& node) const {
    const Four from = larger(node.low[axis_[2]] - origin_[2], Four{} + first_) - slack_;
    const Four to = smaller(node.high[axis_[2]] - origin_[2], Four{} + last_) + slack_;
    Four gap = from - to;
    for (std::size_t side = 0; side < 2; ++side) {
        const Four a = shear_[side] * from, b = shear_[side] * to;
        const Four left = node.low[axis_[side]] - origin_[side],
                   right = node.high[axis_[side]] - origin_[side];
        gap = larger(gap, left - larger(a, b) - slack_);
        gap = larger(gap, smaller(a, b) - right - slack_);
    }
    return gap;
}

} // namespace mane
