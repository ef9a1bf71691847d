#include "interactions/rod.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr float kOverRounding = 1 + 1e-4f;

} // namespace

float widest(const ContactPoints& points, std::uint32_t rank) {
    const float radius = std::max(points.largest[rank], points.largest[points.order.next(rank)]);
    return radius * points.bulge;
}

Rod volume_rod(const ContactPoints& points, std::uint32_t rank) {
    const std::uint32_t next = points.order.next(rank);
    const Vec3 normal = first_three(points.normal[rank]), other = first_three(points.normal[next]),
               axis = first_three(points.position[next]) - first_three(points.position[rank]);
    Rod rod{first_three(points.position[rank]), first_three(points.direction[rank]),
            kEverywhere.radius};
    // Between planes that lean differently a point is off the axis by this, along their mean.
    const float lean = std::fabs(dot(axis, normal - other)) / 4, facing = dot(normal, other);
    if (facing > -0.9f) {
        const float round = widest(points, rank), off = lean * lean * 2 / (1 + facing);
        rod.radius = std::sqrt(round * round + off) * kOverRounding + kRodMargin;
    }
    return rod;
}

} // namespace mane
