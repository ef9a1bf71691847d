// Sixteen boxes of a node at once. Included like base/pack-inl.h.
#if defined(MANE_INTERACTIONS_BOX_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_INTERACTIONS_BOX_SEARCH_INL_H
#undef MANE_INTERACTIONS_BOX_SEARCH_INL_H
#else
#define MANE_INTERACTIONS_BOX_SEARCH_INL_H
#endif

#include "base/pack-inl.h"
#include "interactions/box_tree.h"
#include "interactions/rod.h"

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

/// Boxes as a rod sees them: it passes a box by where, across the rod and one of the world's axes,
/// both are apart. (Across two edges that are not parallel; of those are the three that count, the
/// box itself having been asked.)
class RodView {
  public:
    HWY_INLINE explicit RodView(const Rod& rod) : rod_(rod) {
        const auto across = [&](float a, float b) { return rod.radius * std::sqrt(a * a + b * b); };
        thickness_ = {across(rod.way.y, rod.way.z), across(rod.way.z, rod.way.x),
                      across(rod.way.x, rod.way.y)};
    }

    HWY_INLINE Mask may_meet(const BoxTree::Node& node, std::size_t lane) const {
        const Pack half(0.5f);
        Pack to[3], size[3]; // to the middle of the box; half of its sides
        const auto take = [&](int axis, const float* low, const float* high, float x) {
            const Pack l = Pack::load(low + lane), h = Pack::load(high + lane);
            to[axis] = (l + h) * half - Pack(x);
            size[axis] = (h - l) * half;
        };
        take(0, node.low_x, node.high_x, rod_.x.x);
        take(1, node.low_y, node.high_y, rod_.x.y);
        take(2, node.low_z, node.high_z, rod_.x.z);
        const auto across = [&](int a, int b, float way_a, float way_b, float thickness) {
            const Pack gap = absolute(to[a] * Pack(way_b) - to[b] * Pack(way_a)),
                       reach = size[a] * Pack(std::fabs(way_b)) + size[b] * Pack(std::fabs(way_a)) +
                               Pack(thickness + kRodMargin);
            return gap <= reach;
        };
        const Vec3& w = rod_.way;
        return both(
            both(across(1, 2, w.y, w.z, thickness_.x), across(2, 0, w.z, w.x, thickness_.y)),
            across(0, 1, w.x, w.y, thickness_.z));
    }

    /// One bit per child that the rod may meet.
    HWY_INLINE std::uint32_t children(const BoxTree::Node& node) const {
        std::uint32_t bits = 0;
        for (std::size_t lane = 0; lane < kLanes; lane += kPackLanes)
            bits |= bits_of(may_meet(node, lane)) << lane;
        return bits;
    }

  private:
    Rod rod_;
    Vec3 thickness_;
};

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
