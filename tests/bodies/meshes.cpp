#include "bodies/meshes.h"

#include "base/functions.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

namespace mane::test {

Mesh icosphere(int levels, float radius, const Vec3& centre) {
    const float g = 1.618034f;
    Mesh mesh{{{-1, g, 0},
               {1, g, 0},
               {-1, -g, 0},
               {1, -g, 0},
               {0, -1, g},
               {0, 1, g},
               {0, -1, -g},
               {0, 1, -g},
               {g, 0, -1},
               {g, 0, 1},
               {-g, 0, -1},
               {-g, 0, 1}},
              {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
               {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
               {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
        const auto between = [&](std::uint32_t a, std::uint32_t b) {
            const auto [it, fresh] = middle.try_emplace(
                {std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(mesh.vertices.size()));
            if (fresh)
                mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) * 0.5f);
            return it->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::uint32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    for (Vec3& v : mesh.vertices)
        v = centre + normalized(v) * radius;
    return mesh;
}

Mesh torus(int major, int minor, float ring_radius, float tube_radius) {
    Mesh mesh;
    for (int i = 0; i < major; ++i) {
        for (int j = 0; j < minor; ++j) {
            const double a = 2 * kPi * i / major, b = 2 * kPi * j / minor;
            const double r = ring_radius + tube_radius * cosine(b);
            mesh.vertices.emplace_back(Vec3d{r * cosine(a), tube_radius * sine(b), r * sine(a)});
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(i % major * minor + j % minor);
    };
    for (int i = 0; i < major; ++i) {
        for (int j = 0; j < minor; ++j) {
            mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
            mesh.triangles.push_back({at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)});
        }
    }
    return mesh;
}

Mesh box(const Vec3& low, const Vec3& high, int n) {
    Mesh mesh;
    // Each side has its own vertices; the surface joins them again.
    const auto side = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) {
                Vec3 p = corner + u * (float(i) / float(n)) + v * (float(j) / float(n));
                // exactly on the box, so that neighbouring sides share their edges
                p = {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y),
                     std::clamp(p.z, low.z, high.z)};
                mesh.vertices.push_back(p);
            }
        }
        const auto at = [&](int i, int j) {
            return first + static_cast<std::uint32_t>(i * (n + 1) + j);
        };
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
        }
    };
    const Vec3 x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
    side(low, y, x);
    side(low, z, y);
    side(low, x, z);
    side(low + z, x, y);
    side(low + x, y, z);
    side(low + y, z, x);
    return mesh;
}

Mesh together(const Mesh& a, const Mesh& b) {
    Mesh both = a;
    const auto first = static_cast<std::uint32_t>(a.vertices.size());
    both.vertices.insert(both.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const auto& t : b.triangles)
        both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return both;
}

Mesh cut_below(const Mesh& mesh, float height) {
    Mesh cut{mesh.vertices, {}};
    for (const auto& t : mesh.triangles) {
        const float mean =
            (mesh.vertices[t[0]].y + mesh.vertices[t[1]].y + mesh.vertices[t[2]].y) / 3;
        if (mean > height)
            cut.triangles.push_back(t);
    }
    return cut;
}

Mesh moved(const Mesh& mesh, const Vec3& by) {
    Mesh result = mesh;
    for (Vec3& v : result.vertices)
        v += by;
    return result;
}

Mesh data_mesh(const std::string& path, float size, bool& found) {
    const char* folder = std::getenv("MANE_DATA");
    std::ifstream file((folder ? std::string(folder) : MANE_SOURCE_DIR "/../shared/data") + "/" +
                       path);
    found = static_cast<bool>(file);
    if (!found) {
        const char* strict = std::getenv("CI");
        if (strict && std::string(strict) == "true")
            FAIL("missing: " << path);
        MESSAGE("skipped: " << path << " missing");
        return {};
    }
    Mesh mesh;
    for (std::string line; std::getline(file, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            Vec3 v;
            words >> v.x >> v.y >> v.z;
            mesh.vertices.push_back(v);
        } else if (word == "f") {
            std::vector<std::uint32_t> face;
            while (words >> word)
                face.push_back(static_cast<std::uint32_t>(std::stoul(word) - 1));
            for (std::size_t i = 2; i < face.size(); ++i)
                mesh.triangles.push_back({face[0], face[i - 1], face[i]});
        }
    }
    Vec3 low = mesh.vertices[0], high = low;
    for (const Vec3& v : mesh.vertices) {
        low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
    }
    const Vec3 middle = (low + high) * 0.5f;
    for (Vec3& v : mesh.vertices)
        v = (v - middle) * (size / (high.y - low.y));
    return mesh;
}

} // namespace mane::test
