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
class WispResponse {
  public:
    explicit WispResponse(const WispContactDesc& desc);

    /// Takes the contacts of a detection. They stay engaged until the next call (M36).
    void engage(const HairView& hair, std::span<const WispContact> contacts);

    /// Changes `velocity` and `radius_rate` of `state`, which `hair` views. `friction_time` [s] > 0
    /// answers the quasi-parallel contacts too, for that long; 0 answers collisions alone.
    void apply(const HairView& hair, State& state, float friction_time, Threads& threads);

    std::span<const WispContact> contacts() const { return contacts_; }

  private:
    /// One side's share in a contact, as its section sees it.
    struct Share {
        std::uint32_t contact = 0;
        float weight = 0;   ///< of the impulse on the skeleton point, with its sign
        ContactPoint point; ///< an envelope point takes the part along its half line
    };
    /// The contacts that are answered together, with their shares by section.
    struct Set {
        std::vector<std::uint32_t> contacts;    ///< indices
        std::vector<std::uint32_t> sections;    ///< sections that take part, sorted
        std::vector<std::uint32_t> first_share; ///< per entry of `sections`, and one more
        std::vector<Share> shares;
        std::vector<std::uint16_t>
            skeleton_count; ///< per section of the groom: contacts that use its skeleton point
        std::vector<float> skeleton_weight; ///< of these contacts together, at least 1
        std::vector<float> envelope_weight; ///< per envelope point of the groom, the same
    };

    void build(const HairView& hair, Set& set, bool with_friction) const;
    Vec3 impulse(const HairView& hair, const Set& set, const WispContact& contact,
                 float friction_time) const;
    void gather(const HairView& hair, const Set& set, std::size_t entry, State& state) const;

    WispContactDesc desc_;
    float sine_fade_;
    std::vector<WispContact> contacts_;
    Set all_, collisions_;
    std::vector<Vec3> impulses_; ///< per contact
};

} // namespace mane
