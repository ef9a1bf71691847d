/// M9: nothing that the head or contacts do not do can move a wisp as a whole.

#include "reference/single_wisp.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace mane;
using namespace mane::reference;

TEST_CASE("a free wisp falls at exactly g with its sections at rest, any orientation and any K") {
    const Surroundings earth = {.gravity = {0, -9.81, 0}, .air_drag = 0};
    for (const std::uint32_t points : {3u, 4u, 5u, 6u, 8u}) {
        for (int way = 0; way < 12; ++way) {
            SingleWisp shape;
            shape.points = points;
            shape.segments = 4;
            const double polar = 0.3 * way, around = 1.1 * way;
            shape.direction = {std::sin(polar) * std::cos(around), std::cos(polar),
                               std::sin(polar) * std::sin(around)};
            shape.across = normalized(cross(shape.direction, Vec3d{0.3, 0.5, -0.8}));
            Wisp wisp = shape.wisp();
            // Float lengths in the groom leave stresses of 1e-7: taken out, so that only gravity is
            // left.
            for (std::size_t i = 0; i < wisp.sections(); ++i) {
                if (i + 1 < wisp.sections())
                    wisp.rest_length[i] = segment_length(wisp, i);
                for (std::size_t k = 0; k < points; ++k)
                    wisp.ring_length[i][k] = ring_distance(wisp, i, k);
            }
            wisp.bend_stiffness.assign(wisp.sections(),
                                       0.0); // so is the last bit of a bend of straight floats
            const Accelerations a = accelerations(wisp, earth);
            for (std::size_t i = 2; i < wisp.sections(); ++i) {
                CHECK(length(a.x[i] - earth.gravity) < 1e-9);
                for (const double out : a.r[i])
                    CHECK(std::abs(out) < 1e-9);
            }
        }
    }
}

TEST_CASE("the air carries a wisp as a whole, and slows its sections alike") {
    SingleWisp shape;
    Wisp wisp = shape.wisp();
    const Surroundings windy = {.gravity = {}, .air_drag = 3};
    for (std::size_t i = 0; i < wisp.sections(); ++i) {
        wisp.air[i] = {2, 0, 1};
        wisp.v[i] = {0.5, 0, 0};
    }
    Wisp still = wisp;
    still.air.assign(wisp.sections(), {0.5, 0, 0}); // no relative wind
    const Accelerations a = accelerations(wisp, windy), b = accelerations(still, windy);
    for (std::size_t i = 2; i < wisp.sections(); ++i) {
        CHECK(length(a.x[i] - b.x[i] - 3.0 * Vec3d{1.5, 0, 1}) < 1e-12);
        for (std::size_t k = 0; k < wisp.points(); ++k)
            CHECK(a.r[i][k] == b.r[i][k]);
    }
}
