#include "designs.h"
#include "groom/attach.h"
#include "mane/error.h"

#include <doctest/doctest.h>

using namespace mane;
using namespace mane::test;

TEST_CASE("the peg is a closed surface that looks outward, its first triangle down") {
    const Body peg = make_peg(0.1f);
    double volume = 0;
    for (std::uint32_t t = 0; t < peg.mesh.triangles.size(); ++t) {
        const auto& c = peg.mesh.triangles[t];
        volume += dot(Vec3d(peg.mesh.vertices[c[0]]),
                      cross(Vec3d(peg.mesh.vertices[c[1]]), Vec3d(peg.mesh.vertices[c[2]]))) /
                  6;
    }
    CHECK(volume == doctest::Approx(std::pow(0.1, 3) / (6 * std::sqrt(2.0))).epsilon(1e-5));
    CHECK(triangle_frame(peg.mesh, 0, {1, 0, 0}).normal.y == doctest::Approx(-1));
}

TEST_CASE("roots ride their triangle: offsets in its axes bring back x0, x1 and the first axis") {
    const Body peg = make_peg();
    StraightWisp wisp = hanging();
    for (std::uint32_t triangle = 0; triangle < 4; ++triangle) {
        wisp.triangle = triangle;
        wisp.direction = Vec3(triangle_frame(peg.mesh, triangle, {1, 0, 0}).normal);
        wisp.skeleton.bending_length = 0.5f; // stands in any direction
        const Groom groom = make_groom(std::vector{design(wisp, peg.mesh)}, peg.mesh);
        const WispRoot& root = groom.roots[0];
        const TriangleFrame f = triangle_frame(peg.mesh, root.triangle, root.barycentric);
        const auto outward = [&](const Vec3& o) {
            return f.edge * double{o.x} + f.normal * double{o.y} + f.side * double{o.z};
        };
        CHECK(length(f.origin + outward(root.inside) - Vec3d(groom.position[0])) < 1e-8);
        CHECK(length(f.origin + outward(root.outside) - Vec3d(groom.position[1])) < 1e-8);
        CHECK(length(root.first_axis) == doctest::Approx(1));
        CHECK(std::fabs(dot(outward(root.first_axis), f.normal)) < 1e-6);
    }
}

TEST_CASE("a groom has one number per section, point or wisp, and overrides are per wisp") {
    const Body peg = make_peg();
    std::vector<WispDesign> wisps = {design(hanging(4), peg.mesh), design(hanging(9), peg.mesh)};
    wisps[1].skeleton.strain *= 2;
    wisps[1].envelope.squeeze /= 2;
    const Groom g = make_groom(wisps, peg.mesh);
    const std::size_t sections = 6 + 11;
    CHECK(g.first_section == std::vector<std::uint32_t>{0, 6, 17});
    for (const auto* per_section :
         {&g.skeleton_mass, &g.envelope_mass, &g.stretch_stiffness, &g.stretch_damping,
          &g.rest_length, &g.bend_stiffness, &g.bend_damping, &g.rest_curvature_u,
          &g.rest_curvature_v, &g.radial_stiffness, &g.radial_damping, &g.ring_stiffness,
          &g.ring_damping})
        CHECK(per_section->size() == sections);
    for (const auto* per_point : {&g.radius, &g.rest_radius, &g.ring_length})
        CHECK(per_point->size() == sections * 4);
    CHECK(g.stretch_stiffness[6 + 1] == doctest::Approx(double{g.stretch_stiffness[1]} / 2));
}

TEST_CASE("designs that cannot be are said by wisp") {
    const Body peg = make_peg();
    const WispDesign good = design(hanging(), peg.mesh);
    const auto complaint = [&](auto&& spoil) {
        std::vector<WispDesign> wisps = {good, good};
        spoil(wisps[1]);
        try {
            make_groom(wisps, peg.mesh);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    CHECK(complaint([](WispDesign&) {}) == "");
    CHECK(complaint([](WispDesign& d) { d.position.resize(2); }) ==
          "wisp 1: 2 sections; expected at least 3: x0, x1 and one simulated");
    CHECK(complaint([](WispDesign& d) { d.envelope.points = 3; }) ==
          "wisp 1: envelope.points is 3; expected at least 3 and the same for all wisps");
    CHECK(complaint([](WispDesign& d) { d.radius.pop_back(); }) ==
          "wisp 1: 39 radii; expected 40, one per section and envelope point");
    CHECK(complaint([](WispDesign& d) { d.radius[9] = 0; }) ==
          "wisp 1: section 2: radius 0.000000 m; expected over 0");
    CHECK(complaint([](WispDesign& d) { d.triangle = 4; }) ==
          "wisp 1: rooted in triangle 4; the wearer has 4");
    CHECK(complaint([](WispDesign& d) { d.position[3] = d.position[2]; }) ==
          "wisp 1: segment 2 is 0.000001 m long; expected over 0.00001 m");
    CHECK(complaint([](WispDesign& d) { d.position[4] = d.position[2]; }) ==
          "wisp 1: section 3: a fold; expected bends under 170 degrees");
    CHECK(complaint([](WispDesign& d) {
              d.first_axis = {0, 1, 0};
          }) == "wisp 1: first_axis is along the wisp; expected across it");
    CHECK(complaint([](WispDesign& d) { // sideways: an upper spring carries its point, a lower one
                                        // hangs it up
              for (std::size_t i = 1; i < d.position.size(); ++i)
                  d.position[i] = {0.05f * float(i), -0.05f, 0};
              d.first_axis = {0, 0, 1};
              d.radius[20 + 1] = 1e-4f;
          })
              .find("a radius of 0.000100 m is too small for its envelope point's weight; a "
                    "smaller envelope.squeeze") != std::string::npos);
}
