#pragma once

#include "base/aligned.h"
#include "base/bins.h"
#include "base/four.h"
#include "base/parallel_for.h"
#include "interactions/contact_matrix.h"
#include "interactions/wisp_contact.h"
#include "mane/contact.h"
#include "mane/desc.h"

#include <span>
#include <vector>

namespace mane {

/// Velocity modifications for contacts between wisps (§4.1, M24–M28): every contact is one impulse
/// between its point and the two ends of its segment, from the same frozen velocities; then each
/// section gathers what concerns it. The result depends neither on the order of contacts (but for
/// rounding) nor on threads.
///
/// Called at three rates: `engage` when contacts were found, `prepare` at the beginning of each
/// detection block, `apply` at every step. Answered less often than every step, friction would let
/// wisps that rest on each other fall in between and shake.
class WispResponse {
  public:
    explicit WispResponse(const WispContactDesc& desc);

    /// Takes the contacts of a detection. They stay engaged until the next call (M36).
    void engage(const HairView& hair, std::span<const WispContact> contacts);

    /// Takes the directions of now for the steps to come, each of `step` [s].
    void prepare(const HairView& hair, float step, Threads& threads);

    /// Changes `velocity` and `radius_rate` of `state` for one step.
    void apply(const HairView& hair, State& state, Threads& threads);

    /// Adds the engaged contacts with their impulses of the last step.
    void list(std::vector<Contact>& contacts) const;

  private:
    /// A contact ready to be answered, in one cache line. A *place* is a section's skeleton point
    /// or one of its envelope points: section · (K + 1) + code.
    struct Answer {
        Four column[3];            ///< of (W + Z)⁻¹
        std::uint32_t point = 0;   ///< its place
        std::uint32_t segment = 0; ///< the place of the first section of its segment
        float s = 0;               ///< along the segment
        float along = 0;           ///< of an axis contact, along the point's own segment
    };
    static_assert(sizeof(Answer) == 64);
    /// An answer's part in a segment, by its two ends.
    struct Share {
        std::uint32_t answer = 0;
        float near = 0, far = 0;
    };

    std::uint32_t place(std::uint32_t section, ContactPoint point = {}) const {
        return section * places_ + point.code;
    }
    void sort_by_place(const HairView& hair, std::span<const WispContact> contacts);
    void weigh();
    void share_segments();
    ContactInput input_of(const HairView& hair, const WispContact& contact) const;
    void take_section(const HairView& hair, std::uint32_t section);
    void take_velocities(const HairView& hair, const State& state, std::uint32_t section);
    Four impulse(const Answer& answer) const;
    Four axis_impulse(const Answer& answer) const;
    void answer_wisp(const HairView& hair, std::size_t wisp, State& state) const;
    void push_section(const HairView& hair, std::uint32_t section, Four on_skeleton,
                      State& state) const;

    WispContactDesc desc_;
    std::uint32_t places_ = 0; ///< K + 1 of a section

    // of a detection
    std::vector<WispContact> contacts_; ///< by place; those of which something can move
    std::size_t axes_ = 0;              ///< axis contacts come last, from here on
    Bins answers_at_;                   ///< per place, but of axis contacts
    std::vector<float> weight_;         ///< per place: of the contacts that share its mass
    Bins shares_of_;                    ///< per section: of the segment that begins there
    std::vector<Share> shares_;
    std::vector<std::uint8_t> takes_part_;      ///< per section
    std::vector<std::uint32_t> sections_;       ///< those that take part
    std::vector<std::uint8_t> wisp_takes_part_; ///< per wisp

    // of a block
    AlignedVector<Answer> answers_;       ///< one per contact
    std::vector<SectionMass> mass_;       ///< per section
    AlignedVector<Four> half_line_;       ///< per place of an envelope point
    std::vector<Vec3> segment_direction_; ///< per section

    // of a step
    AlignedVector<Four> velocity_; ///< per place
    AlignedVector<Four> impulses_; ///< per answer
};

} // namespace mane
