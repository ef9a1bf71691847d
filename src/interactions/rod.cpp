#include "interactions/rod.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr float kOverRounding = 1 + 1e-4f;

} // namespace

float widest(const ContactPoints& points, std::uint32_t rank) {
    return points.bulge *
           std::max(points.shape[rank].largest, points.shape[points.order.next(rank)].largest);
}

Rod volume_rod(const ContactPoints& points, std::uint32_t rank) {
    const SectionShape &near = points.shape[rank], &far = points.shape[points.order.next(rank)];
    Rod rod{near.x, first_three(points.direction[rank]), kEverywhere.radius};
    // Between planes that lean differently a point is off the axis by this, along their mean.
    const float lean = std::fabs(dot(far.x - near.x, near.normal - far.normal)) / 4,
                facing = dot(near.normal, far.normal);
    if (facing > -0.9f) {
        const float round = widest(points, rank), off = lean * lean * 2 / (1 + facing);
        rod.radius = std::sqrt(round * round + off) * kOverRounding + kRodMargin;
    }
    return rod;
}

} // namespace mane
