#include "mane/scene.h"

#include "base/functions.h"
#include "mane/error.h"

#include <algorithm>
#include <map>

namespace mane {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

Mesh unit_box() {
    Mesh box;
    for (int corner = 0; corner < 8; ++corner)
        box.vertices.push_back(
            {corner & 1 ? 0.5f : -0.5f, corner & 2 ? 0.5f : -0.5f, corner & 4 ? 0.5f : -0.5f});
    box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return box;
}

/// Each triangle becomes four, with the new corners pushed out to the sphere.
Mesh subdivided(const Mesh& sphere) {
    Mesh finer{sphere.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [found, added] = middles.try_emplace(
            std::minmax(a, b), static_cast<std::uint32_t>(finer.vertices.size()));
        if (added)
            finer.vertices.push_back(normalized(sphere.vertices[a] + sphere.vertices[b]) * 0.5f);
        return found->second;
    };
    for (const auto& [a, b, c] : sphere.triangles) {
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (const Triangle& t :
             {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
            finer.triangles.push_back(t);
    }
    return finer;
}

/// An octahedron refined four times: 2,048 triangles, flat to 0.1 % of the radius.
Mesh unit_sphere() {
    const float r = 0.5f;
    Mesh sphere{
        {{r, 0, 0}, {-r, 0, 0}, {0, r, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
        {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
    for (int level = 0; level < 4; ++level)
        sphere = subdivided(sphere);
    return sphere;
}

Quatd rotation_by(const Vec3& degrees) {
    const Vec3d half = Vec3d(degrees) * (kPi / 360);
    const double angle = length(half);
    if (angle == 0)
        return {};
    const Vec3d axis = half * (sine(angle) / angle);
    return {axis.x, axis.y, axis.z, cosine(angle)};
}

} // namespace

Mesh obstacle_mesh(const ObstacleDesc& obstacle) {
    if (obstacle.shape == ObstacleShape::mesh)
        throw InputError("obstacle \"" + obstacle.name + "\": its shape is in a file");
    Mesh mesh = obstacle.shape == ObstacleShape::box ? unit_box() : unit_sphere();
    for (Vec3& v : mesh.vertices)
        v = {v.x * obstacle.size.x, v.y * obstacle.size.y, v.z * obstacle.size.z};
    return mesh;
}

std::vector<MotionKey> obstacle_keys(const ObstacleDesc& obstacle) {
    std::vector<MotionKey> keys;
    for (const ObstacleKeyDesc& key : obstacle.keys)
        keys.push_back({key.time, Vec3d(key.position), rotation_by(key.rotation)});
    return keys;
}

} // namespace mane
