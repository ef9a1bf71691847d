#pragma once

#include "base/parallel_for.h"
#include "character/surface.h"
#include "interactions/character_point.h"
#include "interactions/character_regions.h"
#include "interactions/character_response.h"
#include "mane/contact.h"
#include "mane/desc.h"
#include "model/ablation.h"

#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace mane {

/// A body that the hair may touch, over one detection block.
struct ContactBody {
    const Surface* surface = nullptr;
    /// Wisps may start inside it (a hat). It leaves alone the part of such a wisp from the root to
    /// its first point outside.
    bool worn = false;
};

/// A skeleton point at a block's start, and where it would be at the end if it had been fixed to
/// the polygon that was nearest then.
struct CarriedPoint {
    Vec3 start;          ///< [m]
    double clear = 0;    ///< [m] nothing of the surface was nearer at the start
    bool found = false;  ///< whether `triangle` was the nearest, `clear` away
    bool settled = true; ///< whether what follows was worked out: it is when first asked for
    bool near = false;   ///< whether any polygon was near enough to be met within the block
    Vec3 position;       ///< [m] at the end, where `near`
    std::uint32_t triangle = PosedSurface::kNoGuess; ///< the nearest, of this block or an earlier
};

/// The hair's contacts with the character and the obstacles (§4.2). Wisps are answered apart from
/// each other, each from root to tip, in fixed chunks: the same bits for any number of threads.
class CharacterContacts {
  public:
    explicit CharacterContacts(const Ablation& ablation = {},
                               const std::string& instruction_set = "")
        : ablation_(ablation), region_test_(region_test_for(instruction_set)) {}

    /// At a block's start, from the state there: finds the planes that a point could reach before
    /// the block ends. Contacts come sorted by wisp, then section.
    void detect(const HairView& hair, std::span<const ContactBody> bodies,
                const CharacterContactDesc& desc, Threads& threads);

    /// In the velocity stage of a step of length `dt` [s] within the block: changes `velocity` and
    /// `radius_rate` of `state`, which `hair` views, as the engaged contacts ask. `fraction`: how
    /// much of the block has passed at the time of the state's positions.
    void respond(const HairView& hair, const CharacterContactDesc& desc, float fraction, float dt,
                 State& state, Threads& threads);

    /// At a block's end, on the new positions (with the frames of the new curve): the penetration
    /// reaction (M31-M33), against the bodies' poses at the block's end. Changes `position` and
    /// `radius` of `state`, which `hair` views. Returns how many points and radii it moved.
    std::uint64_t react(const HairView& hair, std::span<const ContactBody> bodies,
                        const CharacterContactDesc& desc, State& state, Threads& threads);

    /// As if nothing had been looked for yet: hair or bodies are elsewhere at once.
    void forget();
    /// What the last `react` moved, in the order of the sections.
    std::span<const Reaction> reactions() const { return reactions_; }

    std::span<const SlidingContact> of_wisp(std::size_t wisp) const { return contacts_[wisp]; }
    std::uint64_t count() const;
    /// Adds the sliding contacts with their impulses of the last step.
    void list(const Groom& groom, std::vector<Contact>& contacts) const;

  private:
    void begin(const HairView& hair, std::span<const ContactBody> bodies);
    template <int kFours> void respond_with(const HairView& hair, const SlidingStep& step,
                                            State& state, Threads& threads);

    Ablation ablation_;
    RegionTest region_test_;
    std::vector<CharacterRegions> regions_;             // per body
    std::vector<std::vector<SlidingContact>> contacts_; // per wisp
    std::vector<std::vector<CarriedPoint>> carried_;    // per wisp: bodies × sections
    std::vector<Reaction> reactions_;
    double duration_ = 0;
    std::vector<std::vector<Vec3>> impulses_; // per wisp and contact, of the last step
    // scratch, per chunk of wisps: of hair with up to four envelope points, and with more
    std::tuple<std::vector<SlidingResponse<1>>, std::vector<SlidingResponse<2>>> responses_;
};

/// Throws InputError naming the wisp when its x₁ is inside a body that is not worn, in the bodies'
/// poses at the block's start (M5).
void check_roots(const HairView& hair, std::span<const ContactBody> bodies,
                 std::span<const std::string> names);

} // namespace mane
