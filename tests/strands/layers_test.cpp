#include "mane/strands.h"

#include "random_hair.h"

#include <cmath>
#include <doctest/doctest.h>
#include <map>

using namespace mane;
using namespace mane::test;

namespace {

double winding_number(const Mesh& mesh, const Vec3d& p) {
    double sum = 0;
    for (const auto& t : mesh.triangles) {
        const Vec3d a = Vec3d(mesh.vertices[t[0]]) - p, b = Vec3d(mesh.vertices[t[1]]) - p,
                    c = Vec3d(mesh.vertices[t[2]]) - p;
        const double la = length(a), lb = length(b), lc = length(c);
        sum += std::atan2(dot(a, cross(b, c)),
                          la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return sum / (2 * M_PI);
}

double volume(const Mesh& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles)
        sum += dot(Vec3d(mesh.vertices[t[0]]),
                   cross(Vec3d(mesh.vertices[t[1]]), Vec3d(mesh.vertices[t[2]]))) /
               6;
    return sum;
}

} // namespace

TEST_CASE("envelope gauge: depth of known points, for every K") {
    for (std::uint32_t k = 3; k <= 8; ++k) {
        HairRecipe recipe;
        recipe.k = k;
        recipe.wisps = 1;
        recipe.bend = recipe.squeeze = recipe.stretch = 0;
        Hair hair = random_hair(recipe, 1);
        const Vec3d at =
            Vec3d(hair.frame.position[2]) * 0.75 + Vec3d(hair.frame.position[3]) * 0.25;
        const EnvelopeGauge round(hair.groom, hair.frame, 0);
        for (int i = 0; i < 7; ++i) { // one radius for all half lines: a circle
            const Vec3d off{0.009 * std::cos(i), 0, 0.009 * std::sin(i)};
            CHECK(round.depth(at + off, 2.25) ==
                  doctest::Approx(0.009 / recipe.radius).epsilon(1e-5));
        }
        CHECK(round.depth(at, 2.25) == 0);
        CHECK(std::isinf(round.depth(at + Vec3d{0.003, 0.001, 0.003}, 2.25))); // not in the plane

        for (std::size_t section = 0; section < recipe.sections; ++section)
            hair.frame.radius[section * k + 1] *= 2;
        const EnvelopeGauge wide(hair.groom, hair.frame, 0);
        const double angle = 2 * M_PI / k;
        const Vec3d half_line = Vec3d{std::cos(angle), 0, std::sin(angle)} * recipe.radius;
        CHECK(wide.depth(at + half_line, 2.25) == doctest::Approx(0.5).epsilon(1e-5));
        const double share = 1 / std::sqrt(2 + 2 * std::cos(angle)); // α = β on the arc
        CHECK(wide.depth(at + (half_line * 2.0 + Vec3d{recipe.radius, 0, 0}) * share, 2.25) ==
              doctest::Approx(1).epsilon(1e-5));
    }
}

TEST_CASE("envelope mesh: closed, and seen from outside counter-clockwise") {
    HairRecipe recipe;
    recipe.k = 5;
    const Hair hair = random_hair(recipe, 3);
    const Mesh mesh = envelope_mesh(hair.groom, hair.frame, 3, 12);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const auto& t : mesh.triangles)
        for (int i = 0; i < 3; ++i)
            ++edges[{t[i], t[(i + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        CHECK(count == 1);
        CHECK(edges.count({edge.second, edge.first}) == 1);
    }
    CHECK(volume(mesh) > 0);
}

TEST_CASE("envelope mesh: four unequal half lines bound four quarter-ellipses (M14a)") {
    Hair hair = straight_hair(4);
    const float radii[] = {0.01f, 0.02f, 0.015f, 0.005f};
    for (std::size_t i = 0; i < hair.frame.radius.size(); ++i)
        hair.frame.radius[i] = radii[i % 4];
    const std::uint32_t round = 256;
    const double area = M_PI / 4 * (0.01 * 0.02 + 0.02 * 0.015 + 0.015 * 0.005 + 0.005 * 0.01);
    const double inscribed =
        std::sin(2 * M_PI / round) / (2 * M_PI / round); // chords instead of arcs
    CHECK(volume(envelope_mesh(hair.groom, hair.frame, 2, round)) ==
          doctest::Approx(area * inscribed * 0.12).epsilon(1e-5));
}

TEST_CASE("envelope mesh: holds every strand, by winding number in a mesh 2 % wider (M17)") {
    HairRecipe recipe;
    recipe.wisps = 1;
    recipe.bend = 0.4;
    recipe.squeeze = 0.5;
    recipe.radius = 0.008;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        Hair hair = random_hair(recipe, seed);
        StrandDesc desc;
        desc.count = 30;
        desc.distribution = StrandDistribution::rim;
        const Curves curves = make_strands(hair.groom, hair.frame, desc, 5, 4);
        for (float& r : hair.frame.radius)
            r *= 1.02f;
        const Mesh mesh = envelope_mesh(hair.groom, hair.frame, 8, 32);
        for (std::size_t s = 0; s < 30; ++s) // but the ends, which lie in the caps
            for (std::uint32_t v = curves.first_vertex[s] + 1; v + 1 < curves.first_vertex[s + 1];
                 ++v)
                CHECK(winding_number(mesh, Vec3d(curves.position[v])) > 0.5);
    }
}

TEST_CASE("skeleton curves: through every section, as wide as the envelope") {
    const Hair hair = random_hair({}, 6);
    const Curves curves = skeleton_curves(hair.groom, hair.frame, 3);
    CHECK(curves.first_vertex.size() == hair.groom.wisp_count() + 1);
    for (std::size_t w = 0; w < hair.groom.wisp_count(); ++w)
        for (std::uint32_t i = 0; i < hair.groom.sections(w); ++i) {
            const std::size_t section = hair.groom.first_section[w] + i,
                              vertex = curves.first_vertex[w] + 3 * i;
            CHECK(length(curves.position[vertex] - hair.frame.position[section]) < 1e-6f);
            float sum = 0;
            for (int k = 0; k < 4; ++k)
                sum += hair.frame.radius[section * 4 + k];
            CHECK(curves.width[vertex] == doctest::Approx(sum / 2));
        }
}
