/// M30, M32 on the twin: sliding contact with planes that are given.

#include "reference/character.h"
#include "reference/random_groom.h"
#include "reference/random_numbers.h"
#include "reference/single_wisp.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace mane;
using namespace mane::reference;

namespace {

constexpr double kStep = 1e-3;

/// A plane under a point, nearer than the threshold.
SlidingPlane plane_under(const Wisp& wisp, const BodyPoint& point, const Vec3d& normal) {
    SlidingPlane plane;
    plane.point = point;
    plane.normal = normal;
    plane.anchor = position_of(wisp, point) - 0.001 * normal;
    plane.threshold = 0.004;
    return plane;
}

CharacterContactDesc friction(float per_second) {
    CharacterContactDesc desc;
    desc.friction = per_second;
    return desc;
}

BodyPoint skeleton(std::size_t section) {
    BodyPoint point;
    point.section = section;
    return point;
}
BodyPoint envelope(std::size_t section, std::size_t k) {
    BodyPoint point = skeleton(section);
    point.k = k;
    point.alpha = 1;
    return point;
}

/// A point anywhere on a wisp with simulated sections: skeleton, envelope, on the axis, on the
/// surface between.
BodyPoint random_point(const Wisp& wisp, RandomNumbers& random) {
    BodyPoint point;
    point.section = random.count(1, static_cast<std::uint32_t>(wisp.sections() - 2));
    point.along = random.chance(0.5) ? 0 : random.between(0, 1);
    point.k = random.count(0, static_cast<std::uint32_t>(wisp.points() - 1));
    point.alpha = random.chance(0.5) ? 0 : random.between(0, 1);
    point.beta = random.chance(0.5) ? 0 : random.between(0, 1 - point.alpha);
    return point;
}

} // namespace

TEST_CASE("a point that nears the surface keeps its sliding velocity and loses its approach") {
    const Vec3d up = {0, 0, 1};
    for (const BodyPoint& point : {skeleton(4), envelope(4, 1), envelope(4, 0)}) {
        Wisp wisp = SingleWisp{}.wisp();
        for (std::size_t i = 2; i < wisp.sections(); ++i)
            wisp.v[i] = {0.5, 0.2, -1};
        slide(wisp, {plane_under(wisp, point, up)}, friction(0), kStep);
        CHECK(length(velocity_of(wisp, point) - Vec3d{0.5, 0.2, 0}) < 1e-12);
        CHECK(wisp.v[5] == Vec3d{0.5, 0.2, -1}); // the others go on
    }
}

TEST_CASE("a point that leaves the surface is not held") {
    Wisp wisp = SingleWisp{}.wisp();
    wisp.v[4] = {0, 0, 1};
    slide(wisp, {plane_under(wisp, skeleton(4), {0, 0, 1})}, friction(0), kStep);
    CHECK(wisp.v[4] == Vec3d{0, 0, 1});
}

TEST_CASE("approach and sliding are relative to the polygon, which may move and turn") {
    Wisp wisp = SingleWisp{}.wisp();
    SlidingPlane plane = plane_under(wisp, skeleton(4), {0, 0, 1});
    plane.anchor_velocity = {0.3, 0, 2};
    slide(wisp, {plane}, friction(0), kStep);
    CHECK(length(wisp.v[4] - Vec3d{0, 0, 2}) <
          1e-12); // a still point is carried along by the surface

    wisp = SingleWisp{}.wisp();
    slide(wisp, {plane}, friction(1e9f), kStep);
    CHECK(length(wisp.v[4] - Vec3d{0.3, 0, 2}) < 1e-9); // and with boundless friction sideways too

    // The plane turns about its anchor at 10 rad/s, 20 mm beside the point: it rises there by 0.2
    // m/s.
    wisp = SingleWisp{}.wisp();
    plane.anchor_velocity = {};
    plane.anchor -= Vec3d{0.02, 0, 0};
    plane.normal_rate = {-10, 0, 0};
    slide(wisp, {plane}, friction(0), kStep);
    CHECK(wisp.v[4].z == doctest::Approx(0.2));
}

TEST_CASE("the drag on skin is e^(−cΔt), however many points of a section touch") {
    const double kept = std::exp(-5 * kStep);
    Wisp wisp = SingleWisp{}.wisp();
    for (Vec3d& v : wisp.v)
        v = {1, 0, 0};
    const SlidingPlane plane = plane_under(wisp, skeleton(4), {0, 0, 1});
    Wisp often = wisp, far_off = wisp;
    slide(wisp, {plane}, friction(5), kStep);
    CHECK(wisp.v[4].x == doctest::Approx(kept).epsilon(1e-12));
    CHECK(wisp.v[5].x == 1);
    slide(often, {plane, plane_under(often, envelope(4, 0), {0, 0, 1}), plane}, friction(5), kStep);
    CHECK(often.v[4].x == doctest::Approx(kept).epsilon(1e-12));

    SlidingPlane far = plane;
    far.anchor.z -= 0.01;
    slide(far_off, {far}, friction(5), kStep);
    CHECK(far_off.v[4] == Vec3d{1, 0, 0}); // not in contact
}

TEST_CASE("an axis that touches between its sections is dragged where it touches, unless they "
          "touch too") {
    Wisp wisp = SingleWisp{}.wisp();
    for (Vec3d& v : wisp.v)
        v = {1, 0, 0};
    BodyPoint middle = skeleton(4);
    middle.along = 0.5;
    const SlidingPlane between = plane_under(wisp, middle, {0, 0, 1});
    Wisp both = wisp;
    slide(wisp, {between}, friction(5), kStep);
    CHECK(velocity_of(wisp, middle).x == doctest::Approx(std::exp(-5 * kStep)).epsilon(1e-12));
    slide(both, {plane_under(both, skeleton(5), {0, 0, 1}), between}, friction(5), kStep);
    CHECK(both.v[4].x == 1);
    CHECK(both.v[5].x == doctest::Approx(std::exp(-5 * kStep)).epsilon(1e-12));
}

TEST_CASE("nothing passes the threshold within a step, and nothing stops before it") {
    Wisp wisp = SingleWisp{}.wisp();
    SlidingPlane plane = plane_under(wisp, skeleton(4), {0, 0, 1});
    plane.anchor.z = wisp.x[4].z - 0.010; // 6 mm over the threshold
    wisp.v[4] = {0, 0, -20};
    slide(wisp, {plane}, friction(0), kStep);
    CHECK(wisp.v[4].z == doctest::Approx(-6));
    wisp.v[4] = {0, 0, -5};
    slide(wisp, {plane}, friction(0), kStep);
    CHECK(wisp.v[4].z == -5);
}

TEST_CASE("an envelope point pressed along its half line stops alone; the skeleton feels it by the "
          "spring") {
    Wisp wisp = SingleWisp{}.wisp();
    const Vec3d d = half_line(section_frames(wisp)[4], 2, 4);
    wisp.v[4] = d;
    slide(wisp, {plane_under(wisp, envelope(4, 2), -d)}, friction(0), kStep);
    CHECK(length(wisp.v[4] - d) < 1e-14);
    CHECK(wisp.r_rate[4][2] == doctest::Approx(-1));
    CHECK(wisp.r_rate[4][0] == 0);
}

TEST_CASE("in a crease neither wall is approached, and the point keeps what both allow") {
    RandomNumbers random(3);
    for (int trial = 0; trial < 50; ++trial) {
        Wisp wisp = SingleWisp{}.wisp();
        wisp.envelope_mass.assign(wisp.sections(), 1e-12); // the same inertia all ways
        const Vec3d a = random.direction(), across = random.across(a), edge = cross(a, across);
        const Vec3d b = normalized(across + random.between(-0.8, 0.8) * a);
        const Vec3d v = random.vector(2);
        wisp.v[4] = v;
        slide(wisp, {plane_under(wisp, skeleton(4), a), plane_under(wisp, skeleton(4), b)},
              friction(0), kStep);
        // The nearest velocity with v·a ≥ 0 and v·b ≥ 0: v itself, on one wall, on the other, or
        // along the edge.
        const Vec3d candidates[] = {v, v - dot(v, a) * a, v - dot(v, b) * b, dot(v, edge) * edge};
        Vec3d nearest = candidates[3];
        for (const Vec3d& c : candidates)
            if (dot(c, a) > -1e-12 && dot(c, b) > -1e-12 && length(c - v) < length(nearest - v))
                nearest = c;
        CHECK(length(wisp.v[4] - nearest) < 1e-5);
    }
}

TEST_CASE("energy relative to the polygon never rises: any point, K, masses, state, any planes") {
    double most_lost = 0;
    for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
        const RandomHair recipe = {.seed = seed,
                                   .wisps = 1,
                                   .points = static_cast<std::uint32_t>(3 + seed % 6),
                                   .least_sections = 3,
                                   .most_sections = 7};
        const Groom groom = random_groom(recipe);
        Hair hair(groom);
        set_state(hair, random_state(recipe, groom, seed));
        Wisp& wisp = hair.wisps[0];
        wisp.v[0] = wisp.v[1] = {};
        RandomNumbers random(seed);
        std::vector<SlidingPlane> planes;
        const std::uint32_t count = random.count(1, 12);
        for (std::uint32_t i = 0; i < count; ++i)
            planes.push_back(plane_under(wisp, random_point(wisp, random), random.direction()));
        const double before = energy(wisp, {}).kinetic;
        slide(wisp, planes, friction(static_cast<float>(random.between(0, 200))), kStep);
        CHECK(energy(wisp, {}).kinetic <= before * (1 + 1e-12));
        most_lost = std::max(most_lost, 1 - energy(wisp, {}).kinetic / before);
    }
    CHECK(most_lost > 0.5);
}

TEST_CASE("a shift moves a section and leaves its velocities") {
    Wisp wisp = SingleWisp{}.wisp();
    wisp.v[4] = {1, 2, 3};
    wisp.r_rate[4] = {1, 2, 3, 4};
    const Ring radii = {0.01, 0, 0.015, 0.012};
    shift(wisp, {{4, {0.1, 0.2, 0.3}, radii}});
    CHECK(wisp.x[4] == Vec3d{0.1, 0.2, 0.3});
    CHECK(wisp.r[4] == radii);
    CHECK(wisp.v[4] == Vec3d{1, 2, 3});
    CHECK(wisp.r_rate[4] == Ring{1, 2, 3, 4});
}
