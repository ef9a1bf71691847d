#include "step/placement.h"

#include <limits>

namespace mane {
namespace {

std::size_t nearest_vertex(const Mesh& mesh, const Vec3& p) {
    std::size_t best = 0;
    float distance = std::numeric_limits<float>::max();
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3 d = mesh.vertices[i] - p;
        if (dot(d, d) < distance) {
            distance = dot(d, d);
            best = i;
        }
    }
    return best;
}

} // namespace

void place_groom(Simulation& s, const Cast& cast, double time) {
    constexpr double kMoment =
        1e-3; // [s] for the velocity at which the pose carries a section along
    const std::uint32_t k_count = s.groom.envelope_points;
    for (std::uint32_t section = 0; section < s.groom.section_count(); ++section) {
        const Slot slot = s.layout.slot(section);
        const std::size_t vertex = nearest_vertex(cast.body(0).mesh, s.groom.position[section]);
        const Vec3d rest(s.groom.position[section]);
        const Vec3d now = cast.carried_like(vertex, rest, time);
        const Vec3d soon = cast.carried_like(vertex, rest, time + kMoment);
        s.state.position.set(slot, Vec3(now - s.origin));
        s.state.velocity.set(slot, Vec3((soon - now) / kMoment));
        for (std::uint32_t k = 0; k < k_count; ++k)
            s.state.radius.at(slot, k) = s.groom.radius[section * k_count + k];
    }
}

} // namespace mane
