#include "picture/hair_shading.h"
#include "picture/pixel_sample.h"
#include "picture/ray_scene.h"
#include "picture/shadow_volume.h"

#include <cmath>
#include <doctest/doctest.h>
#include <numeric>

using namespace mane;

namespace {

Curves one_strand(const std::vector<Vec3>& points, float width) {
    return {{0, static_cast<std::uint32_t>(points.size())},
            points,
            std::vector<float>(points.size(), width)};
}

} // namespace

TEST_CASE("shadow volume: all of a strand's shadowing width is in the grid") {
    const Curves strand =
        one_strand({{0, 0, 0}, {0.03f, -0.05f, 0.01f}, {0.02f, -0.11f, 0.02f}}, 1e-4f);
    Box box;
    box.enclose(strand.position);
    Volume density(box, 0.004f);
    add_strands(strand, 2, density);
    const double sum =
        std::accumulate(density.values().begin(), density.values().end(), 0.0) * std::pow(0.004, 3);
    const double along = double{length(strand.position[1] - strand.position[0])} +
                         double{length(strand.position[2] - strand.position[1])};
    CHECK(sum == doctest::Approx(2 * along * 1e-4 * M_PI / 4).epsilon(1e-3));
}

TEST_CASE("shadow volume: depth in a uniform slab is the way through it, straight and oblique") {
    Volume slab({{0, 0, 0}, {0.6f, 0.2f, 0.6f}}, 0.01f);
    for (float& v : slab.values())
        v = 3;
    const float bottom = -0.02f,
                top = bottom + 0.01f * static_cast<float>(slab.size()[1] - 1); // two cells more
    const Vec3 p{0.3f, 0.05f, 0.3f};
    for (const Vec3& light :
         {Vec3{0, 1, 0}, normalized(Vec3{0.3f, 1, 0.2f}), normalized(Vec3{-0.7f, 1, 0.1f})})
        CHECK(swept_depth(slab, light).at(p) ==
              doctest::Approx(3 * (top - p.y) / light.y).epsilon(1e-3));
    CHECK(swept_depth(slab, {0, -1, 0}).at(p) == doctest::Approx(3 * (p.y - bottom)).epsilon(1e-3));
    const SkyDirection sky[] = {{{0, 1, 0}, 0.25f}, {{0, -1, 0}, 0.75f}};
    CHECK(visible_sky(slab, sky).at(p) ==
          doctest::Approx(0.25 * std::exp(-3 * double{top - p.y}) +
                          0.75 * std::exp(-3 * double{p.y - bottom}))
              .epsilon(1e-3));
}

TEST_CASE("shadow volume: a surface has its depth across, from large triangles and small") {
    const std::vector<Vec3> corners{
        {0, 0.1f, 0}, {0.3f, 0.1f, 0}, {0.3f, 0.1f, 0.3f}, {0, 0.1f, 0.3f}};
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
    Volume density({{0, 0, 0}, {0.3f, 0.2f, 0.3f}}, 0.01f);
    add_surface(corners, triangles, 2, density);
    CHECK(swept_depth(density, {0, 1, 0}).at({0.15f, 0, 0.1f}) ==
          doctest::Approx(2).epsilon(0.15)); // uneven by its samples
    CHECK(swept_depth(density, {0, 1, 0}).at({0.15f, 0.15f, 0.1f}) == 0);
    const double sum =
        std::accumulate(density.values().begin(), density.values().end(), 0.0) * 1e-6;
    CHECK(sum == doctest::Approx(0.3 * 0.3 * 2).epsilon(1e-4));
}

TEST_CASE("ray scene: ribbons and meshes where they are, with tangent and normal") {
    RayScene scene;
    const std::vector<Vec3> corners{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}};
    CHECK(scene.add_mesh(corners, triangles) == 0);
    CHECK(scene.add_ribbons(one_strand({{-0.5f, 0, 1}, {0, 0, 1}, {0.5f, 0, 1}}, 0.01f), 2) == 1);
    scene.commit();

    const RayHit strand =
        scene.first_hit({0.3f, 0.009f, 3}, {0, 0, -1}); // within the doubled width
    CHECK(strand.shape == 1);
    CHECK(strand.part == 0);
    CHECK(strand.distance == doctest::Approx(2).epsilon(1e-3));
    CHECK(strand.direction.x == doctest::Approx(1).epsilon(1e-4));
    const RayHit mesh = scene.first_hit({0.3f, 0.011f, 3}, {0, 0, -1});
    CHECK(mesh.shape == 0);
    CHECK(mesh.direction.z == doctest::Approx(1).epsilon(1e-4));
    CHECK(!scene.first_hit({5, 0, 3}, {0, 0, -1}));
    CHECK(scene.blocked({0, -0.5f, 3}, {0, 0, -1}));
    CHECK(!scene.blocked({0, -0.5f, 3}, {0, 0, 1}));
}

TEST_CASE("hair shading: the white highlight is on the mirror cone, turned toward the root by "
          "twice the scales' tilt") {
    const HairMaterial black{{0, 0, 0}, 0.2f, 0.06f};
    const Vec3 root_to_tip{0, -1, 0}, viewer{0, 0, 1};
    float best = 0, angle_of_best = 0;
    for (int i = -300; i <= 300; ++i) {
        const float angle = 0.001f * static_cast<float>(i); // of the light, above the horizon
        const Vec3 light{0, std::sin(angle), std::cos(angle)};
        const float r = scattered_once(black, root_to_tip, viewer, light).x;
        if (r > best)
            best = r, angle_of_best = angle;
    }
    CHECK(angle_of_best == doctest::Approx(2 * 0.06f).epsilon(0.02));
}

TEST_CASE("hair shading: under a white sky a strand sends back no more than it gets, and a lighter "
          "one more") {
    float before = 0;
    for (const float colour : {0.02f, 0.3f, 0.95f}) {
        const HairMaterial material{{colour, colour, colour}};
        double sum = 0;
        const int rows = 400, columns = 200;
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const double y = (j + 0.5) / rows * 2 - 1, angle = (i + 0.5) / columns * 2 * M_PI,
                             s = std::sqrt(1 - y * y);
                const Vec3 light(Vec3d{s * std::cos(angle), y, s * std::sin(angle)});
                sum += double{scattered_once(material, {0, -1, 0}, {0, 0, 1}, light).x};
            }
        const double returned = sum * 4 * M_PI / (rows * columns);
        CHECK(returned > double{before});
        CHECK(returned < 1);
        before = static_cast<float>(returned);
    }
}

TEST_CASE(
    "pixel samples: sixteen leave no quarter of a side empty, and differ from pixel to pixel") {
    for (std::uint32_t pixel = 0; pixel < 100; ++pixel) {
        int columns = 0, rows = 0;
        for (std::uint32_t i = 0; i < 16; ++i) {
            const SquarePoint p = PixelSample(pixel, 7, i).point(1);
            columns |= 1 << static_cast<int>(p.x * 4);
            rows |= 1 << static_cast<int>(p.y * 4);
        }
        CHECK(columns == 15); // of 16 independent points, one pixel in 24 would have an empty one
        CHECK(rows == 15);
    }
    CHECK(PixelSample(1, 2, 3).point(0).x != PixelSample(2, 1, 3).point(0).x);
}
