#include "groom/attach.h"

namespace mane {

TriangleFrame triangle_frame(const Mesh& mesh, std::uint32_t triangle, const Vec3& barycentric) {
    const auto& corner = mesh.triangles[triangle];
    const Vec3d a(mesh.vertices[corner[0]]), b(mesh.vertices[corner[1]]),
        c(mesh.vertices[corner[2]]);
    TriangleFrame f;
    f.origin = a * double{barycentric.x} + b * double{barycentric.y} + c * double{barycentric.z};
    f.edge = normalized(b - a);
    f.normal = normalized(cross(b - a, c - a));
    f.side = cross(f.edge, f.normal);
    return f;
}

} // namespace mane
