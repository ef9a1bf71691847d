#pragma once

#include "mane/body.h"
#include "mane/vec.h"

#include <functional>
#include <span>
#include <vector>

namespace mane {

/// A point of the scalp.
struct ScalpPoint {
    std::uint32_t triangle = 0;
    Vec3d barycentric;
    Vec3d position; ///< [m]
    Vec3d normal;   ///< unit, outward
};

/// `count` points of the named triangles, as even as can be: each as far as possible from the
/// others. Only where `accept` says so. Fewer come back if it accepts fewer than `count` of the
/// candidates. In the end each goes `upstream` [m, a vector] as far as there are places.
std::vector<ScalpPoint> spread_roots(const Mesh& mesh, std::span<const std::uint32_t> scalp,
                                     std::size_t count, std::uint32_t seed,
                                     const std::function<bool(const ScalpPoint&)>& accept,
                                     const std::function<Vec3d(const ScalpPoint&)>& upstream);

/// Points on the edge of the region that the named triangles cover: middles of edges with one
/// triangle of the region.
std::vector<Vec3d> region_border(const Mesh& mesh, std::span<const std::uint32_t> scalp);

} // namespace mane
