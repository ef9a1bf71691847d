#pragma once

#include "base/random.h"
#include "mane/desc.h"
#include "strands/catmull_rom.h"
#include "strands/drawn_envelope.h"
#include "strands/strand_layout.h"
#include "strands/waves.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// The order in which a strand takes its random numbers.
enum StrandNumber : std::uint64_t { kPlace, kPlaceAngle, kLength, kPhase, kFirstJitter };

/// One strand's own recipe: its place in the disc, and what it moves away from it.
struct StrandRecipe {
    DiscPoint place;
    float end = 0;   ///< p where it ends, shortened
    float phase = 0; ///< [rad] its own part of the waves' phase
    std::vector<CatmullRom<float>>
        share; ///< per segment: what jitter leaves of its distance from the skeleton
};

/// Makes recipes: everything random about strands, and nothing that a frame changes but where it
/// samples.
class StrandRecipes {
  public:
    StrandRecipes(const Groom& groom, const StrandDesc& desc, std::uint32_t seed,
                  float wave_amplitude);
    /// The recipe of strand `strand` of wisp `wisp`, in place of what `recipe` holds.
    void make(std::size_t wisp, std::size_t strand, StrandRecipe& recipe) const;

  private:
    float designed_end(std::size_t wisp, float share) const;

    StrandDesc desc_;
    std::uint32_t seed_;
    float disc_radius_;
    std::vector<std::uint32_t> first_section_;
    std::vector<float> arc_; // [m] per section: designed length from x₁ on
};

} // namespace mane
