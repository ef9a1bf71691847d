#include "groom/solid.h"

namespace mane {
namespace {

constexpr double kFar = 0.25;

std::vector<Vec3> closed_vertices(const Mesh& mesh, const ClosedMesh& closed) {
    std::vector<Vec3> vertices = mesh.vertices;
    for (const auto& loop : closed.cap_loops) {
        Vec3d sum;
        for (std::uint32_t v : loop)
            sum += Vec3d(mesh.vertices[v]);
        vertices.push_back(Vec3(sum / static_cast<double>(loop.size())));
    }
    return vertices;
}

} // namespace

Solid::Solid(const Mesh& mesh) : closed_(close_borders(mesh)) {
    const std::vector<Vec3> vertices = closed_vertices(mesh, closed_);
    surface_ = PosedSurface(closed_.triangles, vertices);
    surface_.pose(vertices);
}

Solid::Clearance Solid::clearance(const Vec3d& p) const {
    const auto place = surface_.nearest(p, kFar);
    if (!place)
        return {kFar, {0, 1, 0}};
    const double distance = std::sqrt(place->closest.squared);
    if (distance < 1e-9)
        return {0, surface_.normal(place->triangle)};
    const double sign = surface_.inside(p) ? -1 : 1;
    return {sign * distance, (p - place->closest.point) * (sign / distance)};
}

Vec3d Solid::moved_out(Vec3d p, double least) const {
    for (int i = 0; i < 4;
         ++i) { // in a concavity the way out from one side may lead nearer to the other
        const Clearance c = clearance(p);
        if (c.distance >= least)
            break;
        p += c.outward * (least - c.distance);
    }
    return p;
}

} // namespace mane
