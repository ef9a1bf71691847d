#include "mane/error.h"
#include "mane/scene.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <utility>

using namespace mane;

namespace {

/// The volume that a closed surface holds; negative when it is inside out.
double volume(const Mesh& mesh) {
    double sum = 0;
    for (const auto& [a, b, c] : mesh.triangles)
        sum +=
            dot(Vec3d(mesh.vertices[a]), cross(Vec3d(mesh.vertices[b]), Vec3d(mesh.vertices[c]))) /
            6;
    return sum;
}

/// Whether each edge is used once in either direction.
bool closed(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const auto& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i)
            ++uses[{t[i], t[(i + 1) % 3]}];
    for (const auto& [edge, count] : uses)
        if (count != 1 || !uses.contains({edge.second, edge.first}))
            return false;
    return true;
}

} // namespace

TEST_CASE("boxes and ellipsoids are closed, counter-clockwise and of their size") {
    ObstacleDesc obstacle;
    obstacle.size = {0.1f, 0.2f, 0.4f};
    const Mesh box = obstacle_mesh(obstacle);
    CHECK(closed(box));
    CHECK(volume(box) == doctest::Approx(0.008).epsilon(1e-6));

    obstacle.shape = ObstacleShape::sphere;
    const Mesh ellipsoid = obstacle_mesh(obstacle);
    CHECK(closed(ellipsoid));
    // An inscribed polyhedron of n triangles loses the share 2π/(√3·n)·… < 1 % for 2,048.
    const double whole = 3.14159265 / 6 * 0.008;
    CHECK(volume(ellipsoid) < whole);
    CHECK(volume(ellipsoid) > 0.99 * whole);

    obstacle.shape = ObstacleShape::mesh;
    CHECK_THROWS_AS(obstacle_mesh(obstacle), InputError);
}

TEST_CASE("keys turn about their rotation's axis by its length") {
    ObstacleDesc obstacle;
    obstacle.keys = {{0, {1, 2, 3}, {}}, {1, {}, {0, 90, 0}}, {2, {}, {120, 120, 120}}};
    const std::vector<MotionKey> keys = obstacle_keys(obstacle);
    REQUIRE(keys.size() == 3);
    CHECK(keys[0].position == Vec3d(1, 2, 3));
    CHECK(keys[0].rotation == Quatd{});
    CHECK(length(keys[1].rotation.rotate(Vec3d(0, 0, 1)) - Vec3d(1, 0, 0)) < 1e-12);
    // 120·√3 degrees about the space diagonal: Rodrigues' formula for the image of x.
    const double angle = 120 * std::sqrt(3.0) * 3.14159265358979 / 180;
    const double c = std::cos(angle), s = std::sin(angle) / std::sqrt(3.0), k = (1 - c) / 3;
    CHECK(length(keys[2].rotation.rotate(Vec3d(1, 0, 0)) - Vec3d(c + k, k + s, k - s)) < 1e-12);
}
