#include "base/random.h"
#include "bodies/brute_surface.h"
#include "bodies/meshes.h"
#include "character/box_tests.h"
#include "character/surface.h"
#include "instruction_sets.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

using namespace mane;
using namespace mane::test;

namespace {

struct Case {
    std::string name;
    Mesh mesh;
};

std::vector<Case> small_meshes() {
    return {{"icosphere", icosphere(2, 0.1f)},
            {"torus", torus(24, 12, 0.1f, 0.03f)},
            {"overlapping spheres",
             together(icosphere(2, 0.1f), icosphere(2, 0.08f, {0.07f, 0.02f, 0}))},
            {"sphere within a sphere", together(icosphere(2, 0.1f), icosphere(1, 0.05f))},
            {"open hemisphere", cut_below(icosphere(3, 0.1f), 0)},
            {"box with split vertices", box({-0.1f, -0.05f, -0.02f}, {0.1f, 0.05f, 0.02f}, 3)}};
}

/// The data's meshes where they are to be had.
std::vector<Case> real_meshes() {
    std::vector<Case> cases;
    for (const char* path : {"heads/suzanne.obj", "heads/LeePerrySmith.obj",
                             "hair/ruby/ruby_head.obj", "hair/ruby/head_max4.obj"}) {
        bool found = false;
        Mesh mesh = data_mesh(path, 0.4f, found);
        if (found)
            cases.push_back({path, std::move(mesh)});
    }
    return cases;
}

Vec3d random_point(const Random& random, std::uint64_t n, double size) {
    return {(random.unit(3 * n) - 0.5) * size, (random.unit(3 * n + 1) - 0.5) * size,
            (random.unit(3 * n + 2) - 0.5) * size};
}

/// Points everywhere and, half of them, near the surface.
std::vector<Vec3d> points_about(const Mesh& mesh, std::size_t count, double size) {
    const Random random(7, mesh.triangles.size());
    std::vector<Vec3d> points;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d p = random_point(random, i, size);
        const auto& t = mesh.triangles[random.bits(1000000 + i) % mesh.triangles.size()];
        points.push_back(i % 2 ? p : Vec3d(mesh.vertices[t[i % 3]]) + p * 0.05);
    }
    return points;
}

struct Twin {
    ClosedMesh closed;
    std::vector<Vec3> vertices;
    explicit Twin(const Mesh& mesh)
        : closed(close_borders(mesh)), vertices(closed_vertices(closed, mesh.vertices)) {}

    double winding(const Vec3d& p) const { return winding_number(closed, vertices, p); }
    double distance(std::size_t t, const Vec3d& p) const {
        const auto& c = closed.triangles[t];
        return distance_to_triangle(p, Vec3d(vertices[c[0]]), Vec3d(vertices[c[1]]),
                                    Vec3d(vertices[c[2]]));
    }
    double distance(const Vec3d& p) const {
        double best = 1e30;
        for (std::size_t t = 0; t < closed.triangles.size(); ++t)
            best = std::min(best, distance(t, p));
        return best;
    }
};

void check_queries(const Case& c, std::size_t count) {
    CAPTURE(c.name);
    const Surface surface(c.mesh);
    const PosedSurface& posed = surface.start();
    const Twin twin(c.mesh);
    std::vector<SurfacePlace> places;
    std::vector<Crossing> crossings;
    Vec3d previous{0.5, 0.5, 0.5};
    for (const Vec3d& p : points_about(c.mesh, count, 0.5)) {
        const double distance = twin.distance(p);
        const auto nearest = posed.nearest(p, 1);
        REQUIRE(nearest);
        CHECK(std::sqrt(nearest->closest.squared) == doctest::Approx(distance).epsilon(1e-9));
        CHECK(length(p - nearest->closest.point) == doctest::Approx(distance).epsilon(1e-9));
        CHECK(twin.distance(nearest->triangle, p) == doctest::Approx(distance).epsilon(1e-9));
        // a guess, good or bad, changes nothing
        for (std::uint32_t guess : {0u, nearest->triangle, 1000000u}) {
            const auto again = posed.nearest(p, 1, guess);
            REQUIRE(again);
            CHECK(again->triangle == nearest->triangle);
            CHECK(again->closest.squared == nearest->closest.squared);
        }
        CHECK_FALSE(posed.nearest(p, distance * 0.999));
        const auto anywhere = posed.nearest(p, std::numeric_limits<double>::infinity());
        REQUIRE(anywhere);
        CHECK(anywhere->triangle == nearest->triangle);

        const double radius = distance + 0.02;
        posed.within(p, radius, places);
        std::size_t expected = 0;
        for (std::size_t t = 0; t < twin.closed.triangles.size(); ++t)
            expected += twin.distance(t, p) <= radius;
        CHECK(places.size() == expected);

        const double winding = twin.winding(p);
        if (distance > 1e-6) {
            CHECK(posed.winding(p) == doctest::Approx(winding).epsilon(1e-6));
            posed.crossings(previous, p, crossings);
            int sum = 0;
            double last = 0;
            for (const Crossing& crossing : crossings) {
                sum += crossing.sign;
                CHECK(crossing.at >= last);
                last = crossing.at;
                CHECK(twin.distance(crossing.triangle, previous + (p - previous) * crossing.at) <
                      1e-7);
            }
            CHECK(sum == std::lround(winding - twin.winding(previous)));
            CHECK(posed.crosses(previous, p) == !crossings.empty());
            previous = p;
        }
    }
}

} // namespace

TEST_CASE("queries agree with brute force on small meshes") {
    for (const Case& c : small_meshes())
        check_queries(c, 400);
}

TEST_CASE("queries agree with brute force on real heads, open and non-manifold") {
    for (const Case& c : real_meshes())
        check_queries(c, 40);
}

namespace {

bool same(const SurfacePlace& a, const SurfacePlace& b) {
    return a.triangle == b.triangle && a.closest.squared == b.closest.squared &&
           a.closest.point == b.closest.point && a.closest.barycentric == b.closest.barycentric;
}

/// Whether two surfaces answer alike, to the bit.
bool alike(const PosedSurface& a, const PosedSurface& b, const Vec3d& p) {
    const auto nearest = a.nearest(p, 1), other = b.nearest(p, 1);
    std::vector<SurfacePlace> places, others;
    const double radius = std::sqrt(nearest->closest.squared) + 0.02;
    a.within(p, radius, places);
    b.within(p, radius, others);
    const BallHeights heights({0, 0.6f, 0.8f}, Vec3(p), static_cast<float>(radius));
    const BoxHeights& in_box = heights;
    return same(*nearest, *other) &&
           std::equal(places.begin(), places.end(), others.begin(), others.end(), same) &&
           a.roof(heights, -1, 1) == b.roof(heights, -1, 1) &&
           a.roof(in_box, -1, 1) == b.roof(in_box, -1, 1) &&
           a.area(nearest->triangle) == b.area(nearest->triangle);
}

} // namespace

TEST_CASE("queries have the same bits for every instruction set") {
    for (const Case& c : small_meshes()) {
        CAPTURE(c.name);
        const Surface best(c.mesh);
        for (const auto& set : test::on_all_sets(
                 [&](const std::string& name) { return std::make_unique<Surface>(c.mesh, name); }))
            for (const Vec3d& p : points_about(c.mesh, 400, 0.5))
                CHECK(alike(best.start(), set->start(), p));
    }
}

namespace {

bool holds(const TriangleTree::Box& box, const Vec3d& p) {
    return p.x >= double(box.low.x) && p.x <= double(box.high.x) && p.y >= double(box.low.y) &&
           p.y <= double(box.high.y) && p.z >= double(box.low.z) && p.z <= double(box.high.z);
}

/// The highest of many points of the surface within a box, along `way`.
double highest_of(const Twin& twin, const TriangleTree::Box& box, const Vec3d& way) {
    double highest = -1e30;
    for (const auto& t : twin.closed.triangles) {
        const Vec3d a(twin.vertices[t[0]]), b(twin.vertices[t[1]]), c(twin.vertices[t[2]]);
        for (int i = 0; i <= 4; ++i) {
            for (int j = 0; i + j <= 4; ++j) {
                const Vec3d p = a + (b - a) * (i / 4.0) + (c - a) * (j / 4.0);
                if (holds(box, p))
                    highest = std::max(highest, dot(p, way));
            }
        }
    }
    return highest;
}

} // namespace

TEST_CASE("nothing of a surface is over its roof in a box") {
    const Random random(9, 1);
    int near = 0, under = 0;
    for (const Case& c : small_meshes()) {
        CAPTURE(c.name);
        const Surface surface(c.mesh);
        const Twin twin(c.mesh);
        std::uint64_t n = 0;
        for (const Vec3d& p : points_about(c.mesh, 60, 0.3)) {
            ++n;
            const Vec3 middle(p);
            const Vec3 half(random.between(4 * n, 0, 0.06f), random.between(4 * n + 1, 0, 0.06f),
                            random.between(4 * n + 2, 0, 0.06f));
            const TriangleTree::Box box{middle - half, middle + half};
            const Vec3 way = n % 7 == 0 ? Vec3{} : Vec3(normalized(random_point(random, n, 1)));
            const double highest = highest_of(twin, box, Vec3d(way));
            const BoxHeights heights(way, box);
            const float roof = surface.start().roof(heights, -1, 1);
            CHECK(highest <= double(roof));
            CHECK(surface.start().roof(heights, roof, roof) == roof);
            // what is asked for short of the roof is told to be over it
            if (highest > -1)
                CHECK(double(surface.start().roof(heights, -1, float(highest) - 1e-3f)) >
                      highest - 1e-3);
            near += highest > -1 && double(roof) < highest + 0.01;
            under += highest == -1e30 && roof == -1;
        }
    }
    CHECK(near > 30); // it is a bound that says something
    CHECK(under > 30);
}

TEST_CASE("nothing of a surface is over its roof in a ball") {
    const Random random(10, 1);
    int below_that_of_the_box = 0;
    for (const Case& c : small_meshes()) {
        CAPTURE(c.name);
        const Surface surface(c.mesh);
        std::vector<SurfacePlace> around;
        std::uint64_t n = 0;
        for (const Vec3d& p : points_about(c.mesh, 60, 0.3)) {
            ++n;
            const float radius = random.between(n, 0, 0.1f);
            const Vec3d way = normalized(random_point(random, n, 1));
            const BallHeights heights(Vec3(way), Vec3(p), radius);
            const float roof = surface.start().roof(heights, -1, 1);
            surface.start().within(Vec3d(Vec3(p)), double(radius), around);
            for (const SurfacePlace& place : around)
                CHECK(dot(Vec3d(Vec3(way)), place.closest.point) <= double(roof));
            const BoxHeights in_box = heights;
            below_that_of_the_box += roof < surface.start().roof(in_box, -1, 1);
        }
    }
    CHECK(below_that_of_the_box > 30);
}

TEST_CASE("every border is closed: winding numbers are whole everywhere") {
    std::vector<Case> cases = small_meshes();
    for (Case& c : real_meshes())
        cases.push_back(std::move(c));
    // one triangle alone, a triangle the wrong way round, three triangles at one edge
    cases.push_back({"one triangle", {{{0, 0, 0}, {0.1f, 0, 0}, {0, 0.1f, 0}}, {{0, 1, 2}}}});
    Mesh flipped = icosphere(1, 0.1f);
    std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);
    cases.push_back({"one triangle flipped", flipped});
    Mesh fin = icosphere(1, 0.1f);
    fin.vertices.push_back({0.3f, 0.1f, 0});
    fin.triangles.push_back({fin.triangles[0][0], fin.triangles[0][1],
                             static_cast<std::uint32_t>(fin.vertices.size() - 1)});
    cases.push_back({"a fin of one triangle", fin});
    for (const Case& c : cases) {
        CAPTURE(c.name);
        const Twin twin(c.mesh);
        const Random random(3, 1);
        for (std::uint64_t i = 0; i < 30; ++i) {
            const double winding = twin.winding(random_point(random, i, 0.4));
            CHECK(std::abs(winding - std::round(winding)) < 1e-6);
        }
    }
}

TEST_CASE("closing counts what it found") {
    const ClosedMesh sphere = close_borders(icosphere(2, 1));
    CHECK(sphere.open_edges == 0);
    CHECK(sphere.non_manifold_edges == 0);
    CHECK(sphere.triangles.size() == sphere.own_triangles);

    const ClosedMesh split = close_borders(box({0, 0, 0}, {1, 1, 1}, 4));
    CHECK(split.open_edges == 0);
    CHECK(split.cap_loops.empty());

    const ClosedMesh half = close_borders(cut_below(icosphere(3, 1), 0));
    REQUIRE(half.cap_loops.size() == 1);
    CHECK(half.open_edges == half.cap_loops[0].size());
    CHECK(half.triangles.size() == half.own_triangles + half.open_edges);

    Mesh fin = icosphere(1, 1);
    fin.vertices.push_back({3, 1, 0});
    fin.triangles.push_back({fin.triangles[0][0], fin.triangles[0][1],
                             static_cast<std::uint32_t>(fin.vertices.size() - 1)});
    CHECK(close_borders(fin).non_manifold_edges == 1);
}

TEST_CASE("known counts on the real heads") {
    for (const Case& c : real_meshes()) {
        CAPTURE(c.name);
        const ClosedMesh closed = close_borders(c.mesh);
        if (c.name == "heads/suzanne.obj")
            CHECK(closed.open_edges == 42);
        if (c.name == "heads/LeePerrySmith.obj")
            CHECK(closed.non_manifold_edges == 10);
    }
}

TEST_CASE("segments through vertices and edges are crossed exactly once") {
    std::vector<Crossing> crossings;
    for (const Case& c : {Case{"icosphere", icosphere(2, 0.1f)},
                          Case{"box", box({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, 4)}}) {
        CAPTURE(c.name);
        const Surface surface(c.mesh);
        const PosedSurface& posed = surface.start();
        const auto check = [&](const Vec3d& target, const Vec3d& inside) {
            const Vec3d outside = inside + (target - inside) * 4.0;
            posed.crossings(outside, inside, crossings);
            int sum = 0;
            for (const Crossing& crossing : crossings)
                sum += crossing.sign;
            CHECK(sum == 1);
            posed.crossings(inside, outside, crossings);
            sum = 0;
            for (const Crossing& crossing : crossings)
                sum += crossing.sign;
            CHECK(sum == -1);
            posed.crossings(outside, inside * 2.0 - outside, crossings);
            sum = 0;
            for (const Crossing& crossing : crossings)
                sum += crossing.sign;
            CHECK(sum == 0);
            CHECK(crossings.size() >= 2);
        };
        for (const auto& t : c.mesh.triangles) {
            const Vec3d a(c.mesh.vertices[t[0]]), b(c.mesh.vertices[t[1]]);
            for (const Vec3d& inside : {Vec3d{0, 0, 0}, Vec3d{0.01, -0.02, 0.005}}) {
                check(a, inside);
                check((a + b) * 0.5, inside);
                check(a * 0.75 + b * 0.25, inside);
            }
        }
        // along edges and through rows of vertices of the box's sides
        for (double x : {-0.05, 0.0, 0.05, 0.0123}) {
            for (double z : {-0.05, 0.0, 0.05}) {
                posed.crossings({x, 1, z}, {x, 0, z}, crossings);
                int sum = 0;
                for (const Crossing& crossing : crossings)
                    sum += crossing.sign;
                CHECK(sum == 1);
                CHECK(posed.winding({x, 0.02, z}) == 1);
            }
        }
    }
}

TEST_CASE(
    "a point on a face's plane, an edge's line or level with a vertex has a whole winding number") {
    const Surface surface(box({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, 4));
    for (double x : {-0.2, -0.05, 0.0, 0.05, 0.2}) {
        for (double y : {-0.2, -0.05, 0.0, 0.05, 0.2}) {
            for (double z : {-0.2, -0.05, 0.0, 0.05, 0.2}) {
                const bool inside = std::max({std::abs(x), std::abs(y), std::abs(z)}) < 0.1;
                CHECK(surface.start().winding({x, y, z}) == int(inside));
            }
        }
    }
}

TEST_CASE("a filter changes the nearest place, and equally near triangles give the lowest") {
    const Surface surface(icosphere(2, 0.1f));
    const Vec3d p(surface.start().vertices()[0] *
                  1.1f); // nearest: a corner shared by five triangles
    std::vector<SurfacePlace> places;
    surface.start().within(p, 0.0101, places);
    REQUIRE(places.size() >= 5);
    const auto first = surface.start().nearest(p, 1);
    REQUIRE(first);
    CHECK(first->triangle == std::min_element(places.begin(), places.end(), nearer)->triangle);
    const auto other = surface.start().nearest_accepted(
        p, 1, [&](const SurfacePlace& s) { return s.closest.point.y < 0; });
    REQUIRE(other);
    CHECK(other->closest.point.y < 0);
    CHECK(other->closest.squared > first->closest.squared);
}

TEST_CASE("a surface goes on block by block") {
    const Mesh sphere = icosphere(2, 0.1f);
    Surface surface(sphere);
    surface.advance(moved(sphere, {0.01f, 0, 0}).vertices, 0.01);
    CHECK(surface.fastest() == doctest::Approx(1).epsilon(1e-4));
    CHECK(surface.start().inside({-0.095, 0, 0}));
    CHECK_FALSE(surface.end().inside({-0.095, 0, 0}));
    surface.advance(moved(sphere, {0.02f, 0, 0}).vertices, 0.01);
    CHECK_FALSE(surface.start().inside({-0.095, 0, 0}));
    CHECK(surface.start().inside({0.105, 0, 0}));
    CHECK(surface.end().inside({0.115, 0, 0}));
    const Vec3d carried = surface.carried_point(5, {0.2, 0.3, 0.4});
    CHECK(length(carried - Vec3d{0.21, 0.3, 0.4}) < 1e-6);
    surface.reset(sphere.vertices);
    CHECK(surface.end().inside({-0.095, 0, 0}));
    CHECK(surface.fastest() == 0);
}

TEST_CASE("smooth normals point from a sphere's centre, and a box keeps its facets") {
    const Surface sphere(icosphere(3, 0.1f));
    const Random random(1, 1);
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Vec3d out = normalized(random_point(random, i, 1));
        const auto place = sphere.start().nearest(out * 0.12, 1);
        REQUIRE(place);
        // facets of this sphere lean by up to 5°, interpolated normals stay within 1.5°
        CHECK(dot(sphere.smooth_normal(*place), normalized(place->closest.point)) > 0.9996);
    }
    // an inner corner: floor and wall are facets, whatever the corners' means would be
    const Surface stair(together(box({-1, -1, -1}, {1, 0, 1}), box({-1, -1, -1}, {0, 1, 1})));
    const auto floor = stair.start().nearest({0.3, 0.01, 0}, 1);
    REQUIRE(floor);
    CHECK(floor->closest.point.y == 0);
}

TEST_CASE("carrying is exact for a rigid turn") {
    const Mesh sphere = icosphere(2, 0.1f);
    Surface surface(sphere);
    const Quatd turn = normalized(Quatd{0.1, 0.3, -0.2, 1});
    Mesh turned = sphere;
    for (Vec3& v : turned.vertices)
        v = Vec3(turn.rotate(Vec3d(v)) + Vec3d{0.1, 0, 0.05});
    surface.advance(turned.vertices, 0.01);
    const Vec3d p{0.15, -0.03, 0.02};
    for (std::uint32_t t : {0u, 17u, 200u}) {
        CHECK(length(surface.carried_point(t, p) - (turn.rotate(p) + Vec3d{0.1, 0, 0.05})) < 2e-6);
        CHECK(length(surface.carried_direction(t, p) - turn.rotate(p)) < 2e-6);
    }
}
