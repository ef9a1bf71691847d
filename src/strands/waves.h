#pragma once

#include "base/random.h"
#include "mane/desc.h"
#include "mane/frame.h"
#include "mane/groom.h"
#include "strands/place.h"

#include <cstdint>
#include <vector>

namespace mane {

/// The waves of every wisp in one frame (§5.2, M18): a displacement of the strands in the disc.
///
/// The phase belongs to the hair's material: it grows with the designed length, so a stretched
/// segment keeps its number of waves. The amplitude of a stretched segment shrinks by designed
/// length over length; it is relative to the envelope's radius now, since the paper gives it "when
/// the wisp's radius is at rest". A compressed segment keeps its amplitude: the paper scales for
/// stretching only, and a larger one would leave the envelope (M17).
///
/// The strands of a wisp wave together, or it would look frizzy and not wavy: direction and phase
/// are the wisp's, and a strand's phase differs from it by up to `kPhaseSpread`.
class Waves {
  public:
    static constexpr float kPhaseSpread = 0.8f; ///< [rad]

    Waves(const Groom& groom, const Frame& frame, const StrandDesc& desc, std::uint32_t seed);

    /// The largest displacement, in the disc.
    float amplitude() const { return amplitude_; }
    /// The displacement of a strand at p = `piece` + `t`; `offset` [rad] is the strand's own part
    /// of the phase.
    DiscPoint at(std::size_t wisp, std::uint32_t piece, float t, float offset) const;

  private:
    struct Piece {
        float phase, phase_change; // [rad] at the beginning, and along it
        float begin, middle, end;  // what is left of the amplitude there, linear between
    };
    struct Wisp {
        std::size_t first_piece;
        DiscPoint direction;
    };
    void add_wisp(const Groom& groom, const Frame& frame, std::size_t wisp, float waves,
                  const Random& random);

    float amplitude_;
    std::vector<Wisp> wisps_;
    std::vector<Piece> pieces_;
};

} // namespace mane
