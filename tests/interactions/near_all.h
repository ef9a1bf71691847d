#pragma once

#include "interactions/point_test.h"

namespace mane::test {

/// All bunches, each in a box that is everywhere: nothing is passed over for being far.
inline NearBoxes near_all(const ContactPoints& points) {
    constexpr float kFar = 1e30f;
    NearBoxes near;
    near.nodes.resize((points.bunches() + kLanes - 1) / kLanes);
    for (BoxTree::Node& node : near.nodes)
        for (std::size_t i = 0; i < kLanes; ++i)
            node.set(i, {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}});
    for (std::uint32_t bunch = 0; bunch < points.bunches(); ++bunch)
        near.items.push_back(bunch);
    return near;
}

} // namespace mane::test
