#include "character/surface_search.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "character/surface_search.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"
#include "character/closest-inl.h"

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

/// One bit per box of a node for which test(lane) holds.
template <typename Test> HWY_INLINE std::uint32_t boxes_with(Test&& test) {
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < TriangleTree::kBoxes; lane += kPackLanes)
        bits |= bits_of(test(lane)) << lane;
    return bits;
}

/// Squared, never more than to any triangle in the box.
HWY_INLINE Pack squared_distances(const BoxDistances& d, const TriangleTree::Node& node,
                                  std::size_t lane) {
    Pack sum(0.f);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Pack below = Pack::load(node.low[axis] + lane) - Pack(d.above[axis]),
                   above = Pack(d.below[axis]) - Pack::load(node.high[axis] + lane);
        const Pack gap = larger(larger(below, above), Pack(0.f));
        sum = sum + gap * gap;
    }
    return sum * Pack(1 - kBoxRounding);
}

/// Not lower than anything within both boxes; lowest of all where they are apart.
HWY_INLINE Pack highest(const BoxHeights& h, const TriangleTree::Node& node, std::size_t lane) {
    Pack gap(0.f), height(h.slack);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Pack low = larger(Pack::load(node.low[axis] + lane), Pack(h.low[axis])),
                   high = smaller(Pack::load(node.high[axis] + lane), Pack(h.high[axis]));
        gap = larger(gap, low - high);
        height = height + Pack(h.up[axis]) * high + Pack(h.down[axis]) * low;
    }
    return select(gap > Pack(0.f), Pack(BoxHeights::kLowest), height);
}

HWY_INLINE Pack highest(const BallHeights& h, const TriangleTree::Node& node, std::size_t lane) {
    return select(squared_distances(h.distances, node, lane) > Pack(h.squared),
                  Pack(BoxHeights::kLowest),
                  highest(static_cast<const BoxHeights&>(h), node, lane));
}

/// Over 0 where the line stays clear of the box.
HWY_INLINE Pack apart(const BoxCrossings& c, const TriangleTree::Node& node, std::size_t lane) {
    const auto low = [&](std::size_t i) {
        return Pack::load(node.low[c.axis[i]] + lane) - Pack(c.origin[i]);
    };
    const auto high = [&](std::size_t i) {
        return Pack::load(node.high[c.axis[i]] + lane) - Pack(c.origin[i]);
    };
    const Pack slack(c.slack);
    const Pack from = larger(low(2), Pack(c.first)) - slack,
               to = smaller(high(2), Pack(c.last)) + slack;
    Pack gap = from - to;
    for (std::size_t side = 0; side < 2; ++side) {
        const Pack a = Pack(c.shear[side]) * from, b = Pack(c.shear[side]) * to;
        gap = larger(gap, low(side) - larger(a, b) - slack);
        gap = larger(gap, smaller(a, b) - high(side) - slack);
    }
    return gap;
}

/// Goes through the boxes of every node that look_into(node) gives the bits of, and calls visit(i)
/// for the triangles there, i their place in the tree's order, until it returns false.
template <typename LookInto, typename Visit>
HWY_INLINE void walk(const TriangleTree& tree, LookInto&& look_into, Visit&& visit) {
    struct Level {
        std::uint32_t node, left; // of its boxes to look into, those not yet visited
    };
    Level stack[TriangleTree::kLevels];
    if (tree.levels() == 0)
        return;
    const std::size_t top = tree.levels() - 1;
    std::size_t level = top;
    stack[top] = {0, look_into(tree.node(top, 0))};
    for (;;) {
        Level& now = stack[level];
        if (now.left == 0) {
            if (level == top)
                return;
            ++level;
            continue;
        }
        const auto box = static_cast<std::uint32_t>(hwy::Num0BitsBelowLS1Bit_Nonzero32(now.left));
        now.left &= now.left - 1;
        const auto inner = now.node * static_cast<std::uint32_t>(TriangleTree::kBoxes) + box;
        if (level > 0) {
            --level;
            if (now.left != 0) // the next one, meanwhile
                __builtin_prefetch(
                    &tree.node(level, now.node * TriangleTree::kBoxes +
                                          hwy::Num0BitsBelowLS1Bit_Nonzero32(now.left)));
            stack[level] = {inner, look_into(tree.node(level, inner))};
        } else if (!visit(inner)) {
            return;
        }
    }
}

/// The nearest place so far, and what rules out most triangles before their own nearest place is
/// worked out: those wholly under the plane through the place across the way to it. All of that
/// side is farther.
struct Nearest {
    static constexpr double kRounding = 1e-9; // [m] far over that of distances in double

    Vec3d p;
    double limit; // squared
    float limit_of_boxes;
    std::optional<SurfacePlace> place;
    Vec3d away; // unit, from the place to the point
    double plane = 0;

    Nearest(const Vec3d& from, double radius)
        : p(from), limit(radius * radius), limit_of_boxes(BoxDistances::at_least(limit)) {}
    bool rules_out(const std::array<Vec3, 3>& corners) const {
        if (!place)
            return false;
        const auto under = [&](const Vec3& corner) { return dot(Vec3d(corner) - p, away) < plane; };
        return under(corners[0]) && under(corners[1]) && under(corners[2]);
    }
    void take(const SurfacePlace& candidate) {
        const double squared = candidate.closest.squared;
        if (squared > limit || (place && squared == limit && candidate.triangle >= place->triangle))
            return;
        place = candidate;
        limit = squared;
        limit_of_boxes = BoxDistances::at_least(limit);
        away = normalized(p - candidate.closest.point);
        plane = -std::sqrt(limit) - kRounding;
    }
};

std::optional<SurfacePlace> nearest(const SearchedTriangles& in, const Vec3d& p, double radius) {
    const TriangleTree& tree = in.tree;
    Nearest best(p, radius);
    if (tree.levels() == 0)
        return best.place;
    const BoxDistances distances(p);
    Candidates candidates(p);
    const auto look_into = [&](const TriangleTree::Node& node) {
        return boxes_with([&](std::size_t lane) {
            return squared_distances(distances, node, lane) <= Pack(best.limit_of_boxes);
        });
    };
    const auto take_all = [&] {
        candidates.evaluate([&](const ClosestPoint& closest, std::uint32_t i) {
            best.take({tree.order()[i], closest});
        });
    };

    // First down to where the nearest boxes are: what is found there rules out most others.
    std::uint32_t inner = 0;
    for (std::size_t level = tree.levels(); level-- > 0;) {
        const TriangleTree::Node& node = tree.node(level, inner);
        alignas(64) float squared[TriangleTree::kBoxes];
        for (std::size_t lane = 0; lane < TriangleTree::kBoxes; lane += kPackLanes)
            squared_distances(distances, node, lane).store(squared + lane);
        if (level == 0) {
            for (std::uint32_t left = look_into(node); left != 0; left &= left - 1) {
                const auto i = static_cast<std::uint32_t>(inner * TriangleTree::kBoxes +
                                                          hwy::Num0BitsBelowLS1Bit_Nonzero32(left));
                if (candidates.full())
                    take_all();
                candidates.add(i, in.corners[i]);
            }
            take_all();
            break;
        }
        const float* least = squared;
        for (const float* s = squared; s != squared + TriangleTree::kBoxes; ++s)
            if (*s < *least)
                least = s;
        inner = static_cast<std::uint32_t>(inner * TriangleTree::kBoxes +
                                           static_cast<std::size_t>(least - squared));
    }
    walk(tree, look_into, [&](std::uint32_t i) {
        if (!best.rules_out(in.corners[i]))
            candidates.add(i, in.corners[i]);
        if (candidates.full())
            take_all();
        return true;
    });
    take_all();
    return best.place;
}

void within(const SearchedTriangles& in, const Vec3d& p, double radius,
            std::vector<SurfacePlace>& places) {
    const double limit = radius * radius;
    const Pack limit_of_boxes(BoxDistances::at_least(limit));
    const BoxDistances distances(p);
    Candidates candidates(p);
    const auto take_all = [&] {
        candidates.evaluate([&](const ClosestPoint& closest, std::uint32_t i) {
            if (closest.squared <= limit)
                places.push_back({in.tree.order()[i], closest});
        });
    };
    walk(
        in.tree,
        [&](const TriangleTree::Node& node) {
            return boxes_with([&](std::size_t lane) {
                return squared_distances(distances, node, lane) <= limit_of_boxes;
            });
        },
        [&](std::uint32_t i) {
            candidates.add(i, in.corners[i]);
            if (candidates.full())
                take_all();
            return true;
        });
    take_all();
}

void along(const SearchedTriangles& in, const BoxCrossings& line, void* context,
           bool (*visit)(void*, std::uint32_t)) {
    walk(
        in.tree,
        [&](const TriangleTree::Node& node) {
            return boxes_with(
                [&](std::size_t lane) { return apart(line, node, lane) <= Pack(0.f); });
        },
        [&](std::uint32_t i) { return visit(context, i); });
}

template <typename Heights>
float roof(const SearchedTriangles& in, const Heights& heights, float floor, float enough) {
    float roof = floor;
    alignas(64) float height[TriangleTree::kBoxes];
    walk(
        in.tree,
        [&](const TriangleTree::Node& node) {
            return boxes_with([&](std::size_t lane) {
                const Pack here = highest(heights, node, lane);
                here.store(height + lane);
                return here > Pack(roof);
            });
        },
        [&](std::uint32_t i) {
            const float top = height[i % TriangleTree::kBoxes];
            if (top > roof)
                roof = std::max(roof, std::min(top, heights.highest(in.corners[i])));
            return roof <= enough;
        });
    return roof;
}

SurfaceSearch search() {
    return {nearest, within, along, roof<BoxHeights>, roof<BallHeights>};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(search);

const SurfaceSearch& surface_search() {
    static const SurfaceSearch best = [] {
        const ChosenInstructionSet chosen(instruction_set(""));
        return HWY_DYNAMIC_DISPATCH(search)();
    }();
    return best;
}

} // namespace mane
#endif
