#pragma once

#include "base/aligned.h"
#include "base/four.h"
#include "interactions/contact_order.h"
#include "model/state.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mane {

/// How the sections move, or what changes it, by rank: the skeleton point's velocity [m/s] and
/// four by four the radius rates [m/s].
struct SectionMotion {
    AlignedVector<Four> skeleton;
    AlignedVector<Four> rate; ///< `fours` per rank
    std::uint32_t fours = 0;

    void resize(std::size_t ranks, std::uint32_t envelope_points) {
        fours = (envelope_points + 3) / 4;
        skeleton.assign(ranks, Four{});
        rate.assign(ranks * fours, Four{});
    }
};

/// A cross-section at a detection block's beginning: all that is asked of it where something may
/// lie in its surface, in two lines of the cache; where K is 4, most of it in the first.
struct alignas(64) SectionShape {
    Vec3 x;            ///< [m] of the skeleton point
    Vec3 normal, u, v; ///< its own axes; u is half line 0
    float radius[kMaxEnvelopePoints];
    float area, rest_area; ///< Σ r_k r_{k+1} [m²], now and in the design
    float largest;         ///< [m] radius
};

/// All points of the hair that can be in contact, by rank (ContactOrder). Sixteen ranks are a
/// *bunch*: their points lie side by side, first the sixteen skeleton points, then the sixteen
/// first envelope points and so on, so that one vector operation asks something of sixteen. A
/// point's number in this order is its *place*. Positions and directions are those of a detection
/// block's beginning.
struct ContactPoints {
    // fixed
    ContactOrder order;
    std::uint32_t per_section = 0;    ///< K + 1
    std::vector<HalfLine> half_lines; ///< in a section's own axes
    float bulge = 1; ///< of its largest radius, the farthest that the surface is from the skeleton
    std::vector<std::uint32_t> wisp; ///< per rank
    std::vector<std::uint8_t> held;  ///< per rank: by the head (x₀ and x₁)

    // of a block
    AlignedVector<SectionShape> shape; ///< per rank
    AlignedVector<Four> normal;    ///< per rank, once more: each step reads this one of its shape
    AlignedVector<Four> low, high; ///< per rank: corners of the box of its largest disc
    AlignedVector<Four> direction; ///< per rank: of the segment that begins there
    AlignedVector<float> slenderness; ///< its length in mean diameters
    AlignedVector<float> x, y, z;     ///< per place; far away where there is no point, and of x₀
    AlignedVector<Four> half_line;    ///< per place; zero but for envelope points

    // of a step
    SectionMotion motion;
    AlignedVector<Four> velocity; ///< per place; room for more behind

    /// Ranks with those that fill the last bunch.
    std::size_t padded_ranks() const { return std::size_t{bunches()} * kLanes; }
    std::uint32_t bunches() const { return (order.size() + kLanes - 1) / kLanes; }
    std::uint32_t places() const { return bunches() * per_section * kLanes; }
    std::uint32_t place(std::uint32_t rank, std::uint32_t code = 0) const {
        return (rank / kLanes * per_section + code) * kLanes + rank % kLanes;
    }
};

/// Σ r_k r_{k+1} of a section of the design [m²].
float designed_area(const Groom& groom, std::uint32_t section);

/// The points of a groom, not yet placed.
ContactPoints contact_points(const HairView& hair);

/// What moves them, on packets or ranks [first, last), compiled once per instruction set. All give
/// the same bits.
struct ContactPointKernels {
    /// Places, axes and radii of now.
    void (*take_places)(const HairView&, ContactPoints&, std::size_t first_packet,
                        std::size_t last_packet);
    /// Of the segments that begin at these ranks, from those.
    void (*find_directions)(ContactPoints&, std::size_t first_rank, std::size_t last_rank);
    /// Velocities and radius rates of now.
    void (*take_motion)(const HairView&, ContactPoints&, std::size_t first_packet,
                        std::size_t last_packet);
    /// Velocities of all points of bunches [first, last), from those.
    void (*find_velocities)(ContactPoints&, std::size_t first_bunch, std::size_t last_bunch);
    /// Adds a change to velocities and radius rates.
    void (*add_motion)(const ContactPoints&, const Layout&, const SectionMotion& change, State&,
                       std::size_t first_packet, std::size_t last_packet);
};
/// For an instruction set by name, or the machine's best for "".
ContactPointKernels contact_point_kernels(const std::string& instruction_set);

} // namespace mane
