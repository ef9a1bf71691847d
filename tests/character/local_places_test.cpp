#include "base/random.h"
#include "bodies/meshes.h"
#include "character/surface.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

using namespace mane;
using namespace mane::test;

namespace {

/// Whether a triangle has all vertices of the face, edge or corner where a place is.
bool shares(const ClosedMesh& mesh, std::uint32_t triangle, const SurfacePlace& place) {
    const auto &own = mesh.triangles[place.triangle], &others = mesh.triangles[triangle];
    const Vec3d& w = place.closest.barycentric;
    const double weight[3] = {w.x, w.y, w.z};
    for (std::size_t c = 0; c < 3; ++c) {
        if (weight[c] != 0 && std::find(others.begin(), others.end(), own[c]) == others.end())
            return false;
    }
    return true;
}

/// The same one by one.
std::vector<SurfacePlace> local_of(const ClosedMesh& mesh,
                                   const std::vector<SurfacePlace>& places) {
    std::vector<SurfacePlace> local;
    for (const SurfacePlace& place : places) {
        const bool passed = std::any_of(places.begin(), places.end(), [&](const auto& other) {
            return other.closest.squared < place.closest.squared * (1 - 1e-9) &&
                   shares(mesh, other.triangle, place);
        });
        if (!passed)
            local.push_back(place);
    }
    return local;
}

} // namespace

TEST_CASE("what is nearest at its face, edge or corner is what one by one tells") {
    const Random random(11, 1);
    // convex, hollow, and with triangles that share places but no corners
    const Mesh meshes[] = {icosphere(2, 0.1f), torus(24, 12, 0.1f, 0.03f),
                           together(icosphere(2, 0.1f), icosphere(2, 0.08f, {0.07f, 0.02f, 0})),
                           box({-0.1f, -0.05f, -0.02f}, {0.1f, 0.05f, 0.02f}, 3)};
    PlaceRows rows;
    std::vector<SurfacePlace> all, local;
    std::size_t on_faces = 0, elsewhere = 0, most = 0;
    for (const Mesh& mesh : meshes) {
        const Surface surface(mesh);
        for (std::uint64_t n = 0; n < 200; ++n) {
            const auto at = [&](std::uint64_t axis) {
                return double(random.between(4 * n + axis, -0.15f, 0.15f));
            };
            const Vec3d p{at(0), at(1), at(2)};
            const double radius = double(random.between(4 * n + 3, 0.01f, 0.1f));
            surface.start().within(p, radius, all);
            surface.start().local(p, radius, rows, local);
            most = std::max(most, all.size());
            const std::vector<SurfacePlace> expected = local_of(surface.mesh(), all);
            REQUIRE(local.size() == expected.size());
            for (std::size_t i = 0; i < local.size(); ++i) {
                CHECK(local[i].triangle == expected[i].triangle);
                CHECK(local[i].closest.squared == expected[i].closest.squared);
                const Vec3d& w = local[i].closest.barycentric;
                ++(w.x * w.y * w.z != 0 ? on_faces : elsewhere);
            }
        }
    }
    CHECK(on_faces > 50);
    CHECK(elsewhere > 50);
    CHECK(most > 100); // many times a vector's lanes
}
