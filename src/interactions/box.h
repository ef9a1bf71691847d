#pragma once

#include "mane/vec.h"

#include <algorithm>

namespace mane {

/// An axis-aligned box.
struct Box {
    Vec3 low, high;

    /// A box that holds nothing and overlaps none.
    static Box nowhere() {
        constexpr float kFarAway = 1e30f;
        return {{kFarAway, kFarAway, kFarAway}, {-kFarAway, -kFarAway, -kFarAway}};
    }
    /// Grows to hold `p`.
    void add(const Vec3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    bool overlaps(const Box& o) const {
        return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y &&
               low.z <= o.high.z && o.low.z <= high.z;
    }
};

} // namespace mane
