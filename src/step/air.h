#pragma once

#include "mane/desc.h"

#include <array>
#include <vector>

namespace mane {

/// The air's velocity at any place and time (M38): a mean wind and turbulence carried along with
/// it. The turbulence is a sum of plane waves, each across its own direction, so that it has no
/// sources; their sizes go from `gust_size` down by halves with Kolmogorov's fall of energy, and
/// each lives about as long as its eddy needs to turn over.
class Air {
  public:
    explicit Air(const AirDesc& desc);

    bool is_uniform() const { return waves_.empty(); }
    const Vec3& mean() const { return mean_; }
    Vec3 velocity(const Vec3d& position, double time) const;

  private:
    struct Wave {
        Vec3d number;    ///< [rad/m]
        double rate;     ///< [rad/s]
        double phase;    ///< [rad]
        Vec3d amplitude; ///< [m/s], across `number`
    };
    Vec3 mean_;
    std::vector<Wave> waves_;
};

} // namespace mane
