#pragma once

#include "base/parallel_for.h"
#include "interactions/impulse.h"
#include "interactions/wisp_contact.h"
#include "mane/desc.h"

#include <span>
#include <vector>

namespace mane {

/// Velocity modifications for contacts between wisps (§4.1, M24–M28): every contact is one impulse
/// between its point and the two ends of its segment, from the same frozen velocities; then each
/// section gathers what concerns it. The result depends neither on the order of contacts nor on
/// threads.
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

  private:
    /// A section that takes part, with its answer to impulses for the block.
    struct Participant {
        std::uint32_t section = 0;
        std::uint32_t first_share = 0, last_share = 0;
        std::uint32_t shares = 0;  ///< contacts that use its skeleton point
        float skeleton_weight = 0; ///< of these contacts together
        SectionMass mass;
        Vec3 half_lines[kMaxEnvelopePoints];
        float envelope_weight[kMaxEnvelopePoints] =
            {}; ///< of the contacts at each envelope point together
    };
    /// One end of a contact: a participant, and its weight in the relative velocity.
    struct End {
        std::uint32_t participant = 0;
        float weight = 0;
        float compliance = 0; ///< what the weight's square stands for in W
    };
    /// A contact ready to be answered: ends of the point (the second without weight but for axis
    /// contacts), then of the segment.
    struct Answer {
        End ends[4];
        ContactPoint point;
        Symmetric3
            impulse_per_velocity; ///< (W + Z)⁻¹, see docs/model.md, "Each contact is one impulse"
    };
    /// A participant's share in an answer.
    struct Share {
        std::uint32_t answer = 0;
        float weight = 0;
        ContactPoint point; ///< an envelope point takes the part along its half line
    };

    std::uint32_t participant(std::uint32_t section);
    void add_answer(const HairView& hair, const WispContact& contact);
    void add_shares();
    Symmetric3d impulse_per_velocity(const HairView& hair, const WispContact& contact,
                                     const Answer& answer, float step) const;
    Symmetric3d viscosity(const HairView& hair, const WispContact& contact, const Symmetric3d& w,
                          float step) const;
    double sliding_weight(double sine_of_angle) const;
    Vec3 impulse(const Answer& answer, std::uint32_t k_count) const;
    void gather(const HairView& hair, const Participant& participant, State& state) const;

    WispContactDesc desc_;
    float sine_fade_;
    double sine_full_, sine_none_; ///< wisps slide in full under the one, not at all over the other
    std::vector<WispContact> contacts_; ///< those of which something can move
    std::vector<Answer> answers_;       ///< one per contact
    std::vector<Participant> participants_;
    std::vector<Share> shares_; ///< participant after participant, each in the order of contacts
    std::vector<std::uint32_t> participant_of_; ///< per section of the groom

    // of the present step
    std::vector<Vec3> velocities_;    ///< per participant
    std::vector<float> radius_rates_; ///< per participant and envelope point
    std::vector<Vec3> impulses_;      ///< per answer
};

} // namespace mane
