#include "formats/export_formats.h"

#include <array>

namespace mane {
namespace {

struct WideVertex {
    Vec3 position;
    float width;
};

// PLY's list of three: a count of one byte, packed before its indices.
constexpr std::size_t kFaceBytes = 1 + 3 * sizeof(std::uint32_t);

std::string header(std::size_t vertices, const char* more_of_a_vertex, const std::string& element) {
    return "ply\nformat binary_little_endian 1.0\ncomment mane; metres, Y up\nelement vertex " +
           std::to_string(vertices) + "\nproperty float x\nproperty float y\nproperty float z\n" +
           more_of_a_vertex + element + "end_header\n";
}

} // namespace

void write_ply(const Curves& curves, const Vec3d& origin, WholeFile& file) {
    std::vector<WideVertex> vertices;
    vertices.reserve(curves.position.size());
    for (std::size_t v = 0; v < curves.position.size(); ++v)
        vertices.push_back({Vec3(Vec3d(curves.position[v]) + origin), curves.width[v]});
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::size_t s = 0; s + 1 < curves.first_vertex.size(); ++s)
        for (std::uint32_t v = curves.first_vertex[s]; v + 1 < curves.first_vertex[s + 1]; ++v)
            edges.push_back({v, v + 1});

    file.write(header(vertices.size(), "property float width\n",
                      "element edge " + std::to_string(edges.size()) +
                          "\nproperty uint vertex1\nproperty uint vertex2\n"));
    file.write_numbers<WideVertex>(vertices);
    file.write_numbers<std::array<std::uint32_t, 2>>(edges);
}

void write_ply(const Mesh& mesh, const Vec3d& origin, WholeFile& file) {
    file.write(header(mesh.vertices.size(), "",
                      "element face " + std::to_string(mesh.triangles.size()) +
                          "\nproperty list uchar uint vertex_indices\n"));
    std::vector<Vec3> vertices;
    vertices.reserve(mesh.vertices.size());
    for (const Vec3& p : mesh.vertices)
        vertices.emplace_back(Vec3d(p) + origin);
    file.write_numbers<Vec3>(vertices);
    std::string faces;
    faces.reserve(mesh.triangles.size() * kFaceBytes);
    for (const auto& t : mesh.triangles) {
        faces.push_back(3);
        faces.append(reinterpret_cast<const char*>(t.data()), sizeof t);
    }
    file.write(faces);
}

} // namespace mane
