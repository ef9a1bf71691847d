#include "step/roots.h"

#include <cmath>

namespace mane {
namespace {

/// A vector and its rate of change.
struct Moving {
    Vec3d value, rate;
};

Moving unit(const Moving& m) {
    const double l = length(m.value);
    const Vec3d e = m.value / l;
    return {e, (m.rate - e * dot(e, m.rate)) / l};
}

Moving cross(const Moving& a, const Moving& b) {
    return {cross(a.value, b.value), cross(a.rate, b.value) + cross(a.value, b.rate)};
}

} // namespace

RootState root_state(const WispRoot& root, const Mesh& mesh, std::span<const Vec3> vertices,
                     std::span<const Vec3> velocities) {
    const auto& corner = mesh.triangles[root.triangle];
    const auto at = [&](int i) {
        return Moving{Vec3d(vertices[corner[i]]), Vec3d(velocities[corner[i]])};
    };
    const Moving a = at(0), b = at(1), c = at(2);
    const Moving ab{b.value - a.value, b.rate - a.rate}, ac{c.value - a.value, c.rate - a.rate};
    const Moving edge = unit(ab), normal = unit(cross(ab, ac)), side = cross(edge, normal);
    const Vec3d w(root.barycentric);
    const Moving on{a.value * w.x + b.value * w.y + c.value * w.z,
                    a.rate * w.x + b.rate * w.y + c.rate * w.z};

    const auto carried = [&](const Vec3& local) {
        const Vec3d l(local);
        return Moving{edge.value * l.x + normal.value * l.y + side.value * l.z,
                      edge.rate * l.x + normal.rate * l.y + side.rate * l.z};
    };
    const Moving inside = carried(root.inside), outside = carried(root.outside),
                 axis = carried(root.first_axis);
    return {Vec3(on.value + inside.value), Vec3(on.value + outside.value), Vec3(axis.value),
            Vec3(on.rate + inside.rate),   Vec3(on.rate + outside.rate),   Vec3(axis.rate)};
}

namespace {

/// Between two roots on the same place of the skin.
RootState between(const RootState& a, const RootState& b, float share, float rate) {
    const auto at = [share](const Vec3& from, const Vec3& to) {
        return from + (to - from) * share;
    };
    const auto moving = [&](const Vec3& v_from, const Vec3& v_to, const Vec3& from,
                            const Vec3& to) { return at(v_from, v_to) + (to - from) * rate; };
    return {at(a.inside, b.inside),
            at(a.outside, b.outside),
            at(a.axis, b.axis),
            moving(a.inside_velocity, b.inside_velocity, a.inside, b.inside),
            moving(a.outside_velocity, b.outside_velocity, a.outside, b.outside),
            moving(a.axis_velocity, b.axis_velocity, a.axis, b.axis)};
}

} // namespace

void follow_scalp(const Groom& groom, const Layout& layout, const Mesh& mesh,
                  std::span<const Vec3> vertices, std::span<const Vec3> velocities, int end,
                  RootMotion& motion, const RootChange& change) {
    for (std::size_t p = 0; p < layout.packets().size(); ++p) {
        const Packet& packet = layout.packets()[p];
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
            if (packet.wisp[lane] == Layout::kNoWisp)
                continue;
            const std::uint32_t w = packet.wisp[lane];
            RootState r = root_state(groom.roots[w], mesh, vertices, velocities);
            if (!change.from.empty())
                r = between(root_state(change.from[w], mesh, vertices, velocities), r,
                            static_cast<float>(change.share), static_cast<float>(change.rate));
            const auto set = [&](RootMotion::Column column, const Vec3& value,
                                 const Vec3& velocity) {
                const Vec3 slope = velocity * motion.seconds;
                for (int c = 0; c < 3; ++c) {
                    const Slot slot{static_cast<std::uint32_t>(p), lane};
                    const std::uint32_t index = column * 3 + c;
                    motion.value[end].at(slot, index) = c == 0   ? value.x
                                                        : c == 1 ? value.y
                                                                 : value.z;
                    motion.slope[end].at(slot, index) = c == 0   ? slope.x
                                                        : c == 1 ? slope.y
                                                                 : slope.z;
                }
            };
            set(RootMotion::inside, r.inside, r.inside_velocity);
            set(RootMotion::outside, r.outside, r.outside_velocity);
            set(RootMotion::axis, r.axis, r.axis_velocity);
        }
    }
}

} // namespace mane
