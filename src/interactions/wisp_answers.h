#pragma once

#include "base/aligned.h"
#include "base/bins.h"
#include "base/four.h"
#include "interactions/contact_points.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mane {

/// A contact's point on the axis of a segment, between two sections.
struct AxisPoint {
    std::uint32_t rank = 0; ///< of the first section
    std::uint32_t slot = 0; ///< of its contact
    float along = 0;
};

/// All that the answers of contacts between wisps read and write (§4.1).
///
/// Contacts are kept in *slots*, segment by segment and four by four: those of the segment that
/// begins at rank r are in [first[r], first_axis[r]), those that meet it with an axis in
/// [first_axis[r], first[r + 1]), each filled up to a whole number of fours by slots of weight 0,
/// which answer nothing. So the velocities of a segment are fetched once for all of its contacts,
/// and what they give it is summed without being stored. The points of axis contacts
/// have places behind those of all sections.
struct WispAnswers {
    // fixed
    double friction = 0;                 ///< [1/s] at the density of rest
    double sine_fade = 0;                ///< of the angle over which two wisps have a plane in full
    double sine_full = 0, sine_none = 0; ///< they slide in full under the one, not over the other

    // of a detection
    std::vector<std::uint32_t> first, first_axis;
    AlignedVector<std::uint32_t> place; ///< per slot
    /// Per slot: rank of the point's section · 16 + code; 0 of axes and where weight is 0.
    AlignedVector<std::uint32_t> point;
    AlignedVector<float> weight;  ///< per slot
    AlignedVector<float> density; ///< per slot of quasi-parallel wisps; 0 of a collision
    std::vector<AxisPoint> axis_points;
    std::vector<std::uint8_t> takes_part; ///< per rank
    /// Per rank: inverse masses as their contacts share them (M27a).
    AlignedVector<float> shared_across, shared_extra;
    /// Per place of an envelope point: what its own inverse mass adds along its half line.
    AlignedVector<float> shared_envelope;
    /// Per rank: inverse masses 1/T across and along the normal, and 1/m of an envelope point.
    struct InverseMass {
        float across = 0, extra = 0, envelope = 0;
    };
    std::vector<InverseMass> inverse_mass;
    ParallelBins at_section;          ///< per rank: of the contacts at its points
    std::vector<std::uint32_t> entry; ///< their slots and codes: slot · 16 + code
    Bins axes_at;                     ///< per rank: of the axis points next to it
    struct AxisShare {
        std::uint32_t slot;
        float share;
    };
    std::vector<AxisShare> axis_share;

    // of a block
    float step = 0;               ///< [s]
    AlignedVector<Four> diagonal; ///< per slot: xx, yy, zz of −(W + Z)⁻¹, and s along the segment
    AlignedVector<Four> beside; ///< per slot: its xy, yz, zx

    // of a step
    AlignedVector<Four> impulse;   ///< per slot: on the point
    AlignedVector<Four> near, far; ///< per rank: on the ends of the segment that begins there
    SectionMotion change;
};

/// The work on them, on ranks or packets [first, last), compiled once per instruction set. All give
/// the same bits.
struct WispAnswerKernels {
    /// (W + Z)⁻¹ of the contacts of the segments that begin at these ranks.
    void (*find_matrices)(const ContactPoints&, WispAnswers&, std::size_t first_rank,
                          std::size_t last_rank);
    /// Impulses of the contacts of the segments that begin at these ranks.
    void (*find_impulses)(const ContactPoints&, WispAnswers&, std::size_t first_rank,
                          std::size_t last_rank);
    /// What they change at the sections of these ranks.
    void (*find_changes)(const ContactPoints&, WispAnswers&, std::size_t first_rank,
                         std::size_t last_rank);
};
/// For an instruction set by name, or the machine's best for "".
WispAnswerKernels wisp_answer_kernels(const std::string& instruction_set);

} // namespace mane
