/// The judge's insides against slow, obvious ones: solid angles of all triangles, distances
/// to all triangles, and the twin's search for intersections.

#include "check/drawn_curve.h"
#include "check/overlap.h"
#include "check/solid.h"
#include "check/triangle.h"

#include "bodies/meshes.h"
#include "mane/character.h"
#include "mane/strands.h"
#include "reference/interactions.h"
#include "reference/random_groom.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

using namespace mane;
using namespace mane::test;
using judge::ClosedTopology, judge::Solid;

namespace {

/// The triangles of a closed body, corner by corner.
struct Soup {
    std::vector<std::array<Vec3d, 3>> triangles;

    Soup(const ClosedTopology& topology, std::span<const Vec3> vertices) {
        const std::vector<Vec3d> at = topology.positions(vertices);
        for (const auto& [a, b, c] : topology.triangles())
            triangles.push_back({at[a], at[b], at[c]});
    }

    /// By van Oosterom and Strackee's solid angle, exact but for rounding.
    double winding(const Vec3d& p) const {
        double sum = 0;
        for (const auto& t : triangles) {
            const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
            const double la = length(a), lb = length(b), lc = length(c);
            sum += 2 * std::atan2(dot(a, cross(b, c)),
                                  la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
        }
        return sum / (4 * std::numbers::pi);
    }

    double distance(const Vec3d& p) const {
        double least = 1e9;
        for (const auto& [a, b, c] : triangles)
            least = std::min(least, length(judge::nearest_in_triangle(p, a, b, c) - p));
        return least;
    }
};

struct Case {
    const char* name;
    Mesh mesh;
    bool inner_surfaces = false;
};

/// A sphere whose every triangle has its own three vertices.
Mesh apart(const Mesh& mesh) {
    Mesh split;
    for (const auto& t : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(split.vertices.size());
        for (const std::uint32_t v : t)
            split.vertices.push_back(mesh.vertices[v]);
        split.triangles.push_back({first, first + 1, first + 2});
    }
    return split;
}

std::vector<Case> cases() {
    const Mesh ball = icosphere(2, 0.1f, {0.02f, 0, 0});
    return {{"ball", ball},
            {"box along the axes", box({-0.1f, -0.1f, -0.1f}, {0.1f, 0.1f, 0.1f}, 2)},
            {"two overlapping", together(ball, moved(ball, {0.07f, 0.01f, 0})), true},
            {"one inside the other", together(ball, icosphere(1, 0.05f, {0.02f, 0, 0})), true},
            {"two apart", together(ball, moved(ball, {0.3f, 0, 0}))},
            {"ring", torus(24, 12, 0.1f, 0.04f)},
            {"open", cut_below(ball, -0.03f)},
            {"two open ones", cut_below(together(ball, moved(ball, {0.3f, 0, 0})), -0.03f)},
            {"unjoined", apart(ball)},
            {"bust", make_bust().mesh}};
}

/// Points in and around a mesh, some level with its vertices.
std::vector<Vec3d> points_around(const Mesh& mesh, int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    Vec3d low(mesh.vertices[0]), high = low;
    for (const Vec3& v : mesh.vertices) {
        low = {std::min(low.x, double(v.x)), std::min(low.y, double(v.y)),
               std::min(low.z, double(v.z))};
        high = {std::max(high.x, double(v.x)), std::max(high.y, double(v.y)),
                std::max(high.z, double(v.z))};
    }
    const Vec3d size = high - low;
    std::vector<Vec3d> points;
    for (int i = 0; i < count; ++i) {
        Vec3d p = low + Vec3d{size.x * (1.2 * uniform(random) - 0.1),
                              size.y * (1.2 * uniform(random) - 0.1),
                              size.z * (1.2 * uniform(random) - 0.1)};
        const Vec3d v(mesh.vertices[random() % mesh.vertices.size()]);
        if (i % 4 == 1)
            p.x = v.x, p.z = v.z; // straight under or over a vertex
        if (i % 4 == 2)
            p.x = v.x;
        points.push_back(p);
    }
    return points;
}

} // namespace

TEST_CASE("winding numbers equal the sum of solid angles") {
    for (const Case& c : cases()) {
        CAPTURE(std::string(c.name));
        const ClosedTopology topology(c.mesh);
        const Solid solid(topology, c.mesh.vertices);
        const Soup soup(topology, c.mesh.vertices);
        int inside = 0, different = 0;
        for (const Vec3d& p : points_around(c.mesh, 600)) {
            if (soup.distance(p) < 1e-7)
                continue; // on the surface
            const double expected = soup.winding(p);
            REQUIRE(std::fabs(expected - std::round(expected)) < 1e-6); // closed
            different += solid.winding(p) != static_cast<int>(std::lround(expected));
            inside += solid.contains(p);
        }
        CHECK(different == 0);
        CHECK(inside > 50);
    }
}

TEST_CASE("depth is the way out: past inner surfaces, through caps") {
    for (const Case& c : cases()) {
        CAPTURE(std::string(c.name));
        const ClosedTopology topology(c.mesh);
        const Solid solid(topology, c.mesh.vertices);
        const Soup soup(topology, c.mesh.vertices);
        double largest = 0;
        for (const Vec3d& p : points_around(c.mesh, 200)) {
            const double distance = soup.distance(p);
            if (!solid.contains(p) || distance < 1e-7)
                continue;
            const double depth = solid.depth(p);
            largest = std::max(largest, depth);
            if (!c.inner_surfaces)
                CHECK(depth == doctest::Approx(distance).epsilon(1e-9));
            CHECK(depth >= distance * (1 - 1e-9));
            CHECK(std::isinf(solid.depth(p, depth * 0.999)));
            CHECK(solid.depth(p, depth * 1.001) == depth);
        }
        CHECK(largest > 0.02);
    }
    // In the middle of a ball in a ball the inner one does not count.
    const Mesh nested = together(icosphere(3, 0.1f), icosphere(3, 0.05f));
    const Solid solid(ClosedTopology(nested), nested.vertices);
    CHECK(solid.depth({0, 0.06, 0}) == doctest::Approx(0.04).epsilon(0.02));
    CHECK(solid.depth({0, 0.04, 0}) == doctest::Approx(0.06).epsilon(0.02));
}

TEST_CASE("a line meets a ball where it comes closer than its radius") {
    const Mesh ball = icosphere(4, 0.1f);
    const Solid solid(ClosedTopology(ball), ball.vertices);
    CHECK(solid.meets({-1, 0.09, 0}, {1, 0.09, 0}));
    CHECK_FALSE(solid.meets({-1, 0.101, 0}, {1, 0.101, 0}));
    CHECK_FALSE(solid.meets({-1, 0, 0}, {-0.11, 0, 0}));
    CHECK(solid.meets({-1, 0, 0}, {-0.09, 0, 0}));
    CHECK(solid.meets({0.01, 0, 0}, {0.02, 0, 0}));
    CHECK(solid.meets({0.003, 1, 0.004}, {0.003, -1, 0.004}));
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0, 0.15);
    for (int i = 0; i < 2000; ++i) {
        const Vec3d a{normal(random), normal(random), normal(random)},
            b{normal(random), normal(random), normal(random)};
        const double t = std::clamp(-dot(a, b - a) / dot(b - a, b - a), 0.0, 1.0);
        const double nearest = length(a + (b - a) * t);
        if (nearest < 0.0993)
            CHECK(solid.meets(a, b));
        if (nearest > 0.1001)
            CHECK_FALSE(solid.meets(a, b));
    }
}

TEST_CASE("intersections of random hair are those of the twin") {
    for (const std::uint32_t points : {3u, 4u, 6u}) {
        const reference::RandomHair recipe{
            .seed = points, .wisps = 40, .points = points, .most_sections = 12, .spread = 0.06};
        const Groom groom = random_groom(recipe);
        const Frame frame = random_state(recipe, groom, 5);
        reference::Hair twin(groom);
        set_state(twin, frame);
        const judge::HairGeometry hair(groom, frame);
        const judge::Overlaps overlaps(groom, hair);
        std::size_t sum = 0;
        for (const std::uint32_t n : overlaps.count())
            sum += n;
        const std::size_t expected = 2 * detect(twin, {}).intersecting_pairs;
        CAPTURE(expected);
        CHECK(expected > 100);
        CHECK(sum == expected);
    }
}

TEST_CASE("strands are in the drawn envelope, and what is beyond it is measured in radii") {
    const reference::RandomHair recipe{.seed = 4,
                                       .wisps = 5,
                                       .least_sections = 4,
                                       .most_sections = 10,
                                       .sharpest = 60,
                                       .vanishing = false};
    const Groom groom = random_groom(recipe);
    const Frame frame = random_state(recipe, groom, 2);
    const judge::HairGeometry hair(groom, frame);
    StrandDesc desc;
    desc.count = 200;
    StrandShape shape(groom, desc, 1);
    shape.pose(frame);
    std::vector<Vec3> positions(shape.vertex_count());
    std::vector<float> widths(shape.vertex_count());
    shape.fill(positions, widths);
    judge::DrawnSection section;
    double farthest = 0;
    for (std::size_t s = 0; s < shape.strand_count(); ++s)
        for (std::size_t v = shape.first_vertex(s); v < shape.first_vertex(s + 1); ++v) {
            section.place(groom, hair, shape.wisp(s),
                          double{shape.parameter(s, std::uint32_t(v - shape.first_vertex(s)))});
            farthest = std::max(farthest, section.outside(Vec3d(positions[v])));
        }
    CHECK(farthest < 0.001);

    // At a section the envelope's surface is known: the ends of its half lines.
    const std::size_t s = groom.first_section[2] + 2;
    double mean = 0;
    for (std::uint32_t k = 0; k < 4; ++k)
        mean += hair.radius(s, k) / 4;
    section.place(groom, hair, 2, 2);
    for (std::uint32_t k = 0; k < 4; ++k) {
        const Vec3d x = hair.section(s).x, out = hair.half_line(s, k) * hair.radius(s, k);
        CHECK(section.outside(x + out * 0.999) < 1e-6);
        CHECK(section.outside(x + out * 1.1) ==
              doctest::Approx(0.1 * hair.radius(s, k) / mean).epsilon(0.02));
        CHECK(section.outside(x + hair.section(s).n * 0.01) ==
              doctest::Approx(0.01 / mean).epsilon(0.02));
    }
}
