// Sixteen boxes of a node at once. Included like base/pack-inl.h.
#if defined(MANE_INTERACTIONS_BOX_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_INTERACTIONS_BOX_SEARCH_INL_H
#undef MANE_INTERACTIONS_BOX_SEARCH_INL_H
#else
#define MANE_INTERACTIONS_BOX_SEARCH_INL_H
#endif

#include "base/pack-inl.h"
#include "interactions/box_tree.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

HWY_INLINE Mask overlap(const BoxTree::Node& node, std::size_t lane, const Box& box) {
    const auto along = [lane](const float* low, const float* high, float from, float to) {
        return both(Pack::load(low + lane) <= Pack(to), Pack(from) <= Pack::load(high + lane));
    };
    return both(both(along(node.low_x, node.high_x, box.low.x, box.high.x),
                     along(node.low_y, node.high_y, box.low.y, box.high.y)),
                along(node.low_z, node.high_z, box.low.z, box.high.z));
}

/// One bit per child whose box overlaps `box`.
HWY_INLINE std::uint32_t children_in(const BoxTree::Node& node, const Box& box) {
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
        bits |= bits_of(overlap(node, lane, box)) << lane;
    return bits;
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
