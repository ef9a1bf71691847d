#include "check/finite.h"
#include "check/hair_geometry.h"
#include "check/solid.h"
#include "mane/cache.h"
#include "mane/check.h"
#include "mane/error.h"

#include <algorithm>

namespace mane {
namespace {

using namespace judge;

/// Sections that move of themselves: from x₂ on.
template <typename Visit>
void for_simulated(const Groom& groom, std::size_t wisp, const Visit& visit) {
    for (std::size_t s = groom.first_section[wisp] + 2; s < groom.first_section[wisp + 1]; ++s)
        visit(s);
}

/// Of the piece from the section before to section `s`: its length times the mean of both areas.
double volume_before(const Frame& frame, const HairGeometry& hair, std::size_t s) {
    const double along = length(hair.section(s).x - hair.section(s - 1).x);
    return along / 2 *
           (section_area(frame.radius, s - 1, hair.points()) +
            section_area(frame.radius, s, hair.points()));
}

double depth(std::span<const Solid> solids, const Vec3d& p) {
    double deepest = 0;
    for (const Solid& solid : solids)
        if (solid.contains(p))
            deepest = std::max(deepest, solid.depth(p));
    return deepest;
}

double deepest_of_section(std::span<const Solid> solids, const HairGeometry& hair, std::size_t s) {
    double deepest = depth(solids, hair.section(s).x);
    for (std::uint32_t k = 0; k < hair.points(); ++k)
        deepest = std::max(deepest, depth(solids, hair.envelope_point(s, k)));
    return deepest;
}

FrameFigures figures_of(const Groom& groom, const Frame& frame, std::span<const Solid> solids) {
    const HairGeometry hair(groom, frame);
    FrameFigures figures;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        double energy = 0;
        for_simulated(groom, w, [&](std::size_t s) {
            energy += kinetic_energy(groom, frame, hair, s);
            figures.volume += volume_before(frame, hair, s);
            figures.penetration =
                std::max(figures.penetration, deepest_of_section(solids, hair, s));
        });
        figures.wisp_kinetic_energy.push_back(energy);
        figures.kinetic_energy += energy;
    }
    return figures;
}

} // namespace

std::vector<FrameFigures> frame_figures(const CacheReader& run) {
    const std::vector<Body>& bodies = run.setup().bodies;
    std::vector<std::size_t> solid; // worn bodies hold hair
    std::vector<ClosedTopology> topology;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (!bodies[b].worn) {
            solid.push_back(b);
            topology.emplace_back(bodies[b].mesh);
        }

    std::vector<FrameFigures> all;
    for (std::size_t i = 0; i < run.frame_count(); ++i) {
        const Frame frame = run.frame(i);
        if (first_bad_section(run.setup().groom, frame))
            throw InputError("frame " + std::to_string(i) + " holds a number that is not finite");
        std::vector<Solid> solids;
        for (std::size_t b = 0; b < solid.size(); ++b)
            solids.emplace_back(topology[b], run.body_vertices(i, solid[b]));
        all.push_back(figures_of(run.setup().groom, frame, solids));
    }
    return all;
}

} // namespace mane
