#pragma once

#include "mane/desc.h"
#include "mane/frame.h"
#include "strands/designed_length.h"
#include "strands/place.h"

#include <cstdint>
#include <vector>

namespace mane {

/// The waves of every wisp (§5.2, M18): a displacement of the strands in the disc.
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

    Waves(const DesignedLength& designed, const StrandDesc& desc, std::uint32_t seed);
    /// Of a frame that fits the groom.
    void pose(const DesignedLength& designed, const Frame& frame);

    /// The largest displacement, in the disc; 0 if there are no waves.
    float amplitude() const { return amplitude_; }
    /// The way in which a wisp's strands go to and fro: unit.
    DiscPoint direction(std::size_t wisp) const { return wisps_[wisp].direction; }
    /// [rad] where `length` [m] has been designed from x₁ on
    double phase(std::size_t wisp, double length) const {
        return wisps_[wisp].phase + wisps_[wisp].rate * length;
    }
    /// The amplitude that the frame's stretch leaves at a place: linear between the ends and the
    /// middle of a segment.
    float amplitude(std::size_t wisp, AlongWisp at) const {
        const Left& l = left_[wisps_[wisp].first_piece + at.piece];
        return at.t < 0.5f ? l.begin + (l.middle - l.begin) * 2 * at.t
                           : l.middle + (l.end - l.middle) * (2 * at.t - 1);
    }

  private:
    struct Wisp {
        std::size_t first_piece;
        DiscPoint direction;
        double phase, rate; // [rad], [rad/m]
    };
    struct Left {
        float begin, middle, end;
    };
    float amplitude_;
    std::vector<Wisp> wisps_;
    std::vector<Left> left_; // per piece
};

} // namespace mane
