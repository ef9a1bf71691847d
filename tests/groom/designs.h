#pragma once

#include "groom/material.h"
#include "groom/rest.h"
#include "groom/shape.h"
#include "mane/style.h"

#include <cmath>
#include <vector>

namespace mane::test {

inline StraightWisp hanging(std::uint32_t segments = 8) {
    StraightWisp w;
    w.segments = segments;
    w.radius = {0.012f, 0.006f};
    return w;
}

/// A helix round a downward axis that starts sideways: bends in every direction, none of it along
/// gravity.
inline WispDesign curled(std::uint32_t segments = 12, std::uint32_t points = 4) {
    WispDesign d;
    d.envelope.points = points;
    d.strands = 500;
    d.position = {{0.01f, -0.01f, 0}, {0, 0, 0}};
    for (std::uint32_t i = 1; i <= segments; ++i) {
        const double a = 0.7 * i, r = 0.02;
        d.position.push_back(
            {float(r * (1 - std::cos(a)) - 0.004 * i), float(-0.012 * i), float(r * std::sin(a))});
    }
    for (std::size_t i = 0; i < d.position.size(); ++i)
        for (std::uint32_t k = 0; k < points; ++k)
            d.radius.push_back(float(0.008 + 0.001 * k - 0.0002 * double(i)));
    d.first_axis = {0, 0, 1};
    return d;
}

/// All that the balance is made of, in double.
struct Balance {
    Shape shape;
    Material material;
    Rest rest;
};
inline Balance balance(const WispDesign& d, const Vec3d& gravity = {0, -9.81, 0}) {
    const std::vector<Vec3d> position(d.position.begin(), d.position.end());
    Balance b{make_shape(position, Vec3d(d.first_axis)), {}, {}};
    b.material = make_material(d, b.shape);
    b.rest = make_rest(d, b.shape, b.material, gravity);
    return b;
}

} // namespace mane::test
