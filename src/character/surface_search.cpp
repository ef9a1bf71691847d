#include "character/surface_search.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "character/surface_search.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"
#include "character/closest-inl.h"

#include <bit>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

inline constexpr std::uint32_t kLeaf = TriangleTree::kBoxes;

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

/// Not lower than the triangles.
HWY_INLINE Pack highest(const Vec3& along, const TriangleTree::Leaf& leaf, std::size_t lane) {
    const Pack3 way = broadcast(along), size{absolute(way.x), absolute(way.y), absolute(way.z)};
    Pack top(BoxHeights::kLowest);
    for (const auto& corner : leaf.corner) {
        const Pack3 p = Pack3::load(corner[0] + lane);
        const Pack3 far{absolute(p.x), absolute(p.y), absolute(p.z)};
        top = larger(top, dot(way, p) + dot(size, far) * Pack(kBoxRounding));
    }
    return top;
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

/// Goes through the nodes that look_into(node) gives bits of, a bit per box, and calls
/// visit(leaf, bits) for the lowest, until it returns false. Those are visited without bits too: to
/// do nothing costs less than what the processor cannot foresee.
template <typename LookInto, typename Visit>
HWY_INLINE void walk(const TriangleTree& tree, LookInto&& look_into, Visit&& visit) {
    struct Level {
        std::uint32_t node, left; // of its boxes to look into, those not yet visited
    };
    Level stack[TriangleTree::kLevels + 1];
    const std::size_t top = tree.levels(); // its boxes are the last level's nodes
    if (top == 0)
        return;
    std::size_t level = top;
    stack[top] = {0, (1u << tree.top_nodes()) - 1};
    for (;;) {
        Level& now = stack[level];
        if (now.left == 0) {
            if (level == top)
                return;
            ++level;
            continue;
        }
        const auto box = static_cast<std::uint32_t>(std::countr_zero(now.left));
        now.left &= now.left - 1;
        const auto inner = now.node * kLeaf + box;
        const std::uint32_t bits = look_into(tree.node(level - 1, inner));
        if (level > 1)
            stack[--level] = {inner, bits};
        else if (!visit(inner, bits))
            return;
    }
}

/// The nearest place so far.
struct Nearest {
    double limit; // squared
    float limit_of_boxes;
    std::optional<SurfacePlace> place;

    explicit Nearest(double radius)
        : limit(radius * radius), limit_of_boxes(BoxDistances::at_least(limit)) {}
    void take(const SurfacePlace& candidate) {
        const double squared = candidate.closest.squared;
        if (squared > limit || (place && squared == limit && candidate.triangle >= place->triangle))
            return;
        place = candidate;
        limit = squared;
        limit_of_boxes = BoxDistances::at_least(limit);
    }
};

std::optional<SurfacePlace> nearest(const SearchedTriangles& in, const Vec3d& p, double radius) {
    const TriangleTree& tree = in.tree;
    Nearest best(radius);
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
        candidates.evaluate(best.limit, [&](const ClosestPoint& closest, std::uint32_t i) {
            best.take({tree.order()[i], closest});
        });
    };
    const auto add = [&](std::uint32_t leaf, std::uint32_t bits) {
        candidates.add(in.leaves[leaf], bits, leaf * kLeaf);
        if (candidates.full())
            take_all();
        return true;
    };

    // First down to where the nearest boxes are: what is found there rules out most others.
    std::uint32_t inner = 0, nodes = static_cast<std::uint32_t>(tree.top_nodes());
    for (std::size_t level = tree.levels(); --level > 0; nodes = 1) {
        float least = std::numeric_limits<float>::infinity();
        std::uint32_t nearest = 0;
        for (std::uint32_t node = inner; node < inner + nodes; ++node) {
            alignas(64) float squared[kLeaf];
            for (std::size_t lane = 0; lane < kLeaf; lane += kPackLanes)
                squared_distances(distances, tree.node(level, node), lane).store(squared + lane);
            for (std::uint32_t i = 0; i < kLeaf; ++i)
                if (squared[i] < least) {
                    least = squared[i];
                    nearest = node * kLeaf + i;
                }
        }
        inner = nearest;
    }
    add(inner, look_into(tree.node(0, inner)));
    take_all();
    walk(tree, look_into, add);
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
        candidates.evaluate(limit, [&](const ClosestPoint& closest, std::uint32_t i) {
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
        [&](std::uint32_t leaf, std::uint32_t bits) {
            candidates.add(in.leaves[leaf], bits, leaf * kLeaf);
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
        [&](std::uint32_t leaf, std::uint32_t bits) {
            for (; bits != 0; bits &= bits - 1) {
                const auto box = static_cast<std::uint32_t>(std::countr_zero(bits));
                if (!visit(context, leaf * kLeaf + box))
                    return false;
            }
            return true;
        });
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
        [&](std::uint32_t leaf, std::uint32_t bits) {
            alignas(64) float top[TriangleTree::kBoxes];
            for (std::size_t lane = 0; lane < TriangleTree::kBoxes; lane += kPackLanes)
                smaller(Pack::load(height + lane), highest(heights.along, in.leaves[leaf], lane))
                    .store(top + lane);
            for (; bits != 0; bits &= bits - 1)
                roof = std::max(roof, top[std::countr_zero(bits)]);
            return roof <= enough;
        });
    return roof;
}

void areas(std::span<const TriangleTree::Leaf> leaves, std::span<TriangleTree::Areas> areas) {
    for (std::size_t n = 0; n < leaves.size(); ++n)
        for (std::size_t i = 0; i < TriangleTree::kBoxes; i += Doubles::kCount) {
            const auto corner = [&](std::size_t c) -> Doubles3 {
                const auto& axis = leaves[n].corner[c];
                return {Doubles::load(axis[0] + i), Doubles::load(axis[1] + i),
                        Doubles::load(axis[2] + i)};
            };
            const Doubles3 a = corner(0), area = cross(corner(1) - a, corner(2) - a);
            area.x.store(areas[n].axis[0] + i);
            area.y.store(areas[n].axis[1] + i);
            area.z.store(areas[n].axis[2] + i);
        }
}

SurfaceSearch search() {
    return {nearest, within, along, areas, roof<BoxHeights>, roof<BallHeights>};
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(search);

SurfaceSearch surface_search_for(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(search)();
}

} // namespace mane
#endif
