// The nearest points of triangles, some at a time, in double precision.
#if defined(MANE_CHARACTER_CLOSEST_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef MANE_CHARACTER_CLOSEST_INL_H
#undef MANE_CHARACTER_CLOSEST_INL_H
#else
#define MANE_CHARACTER_CLOSEST_INL_H
#endif

#include "base/reals-inl.h"
#include "character/triangle_geometry.h"
#include "character/triangle_tree.h"

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

using Doubles = Reals<8>;
using DoubleMask = Doubles::Mask;
using Doubles3 = Reals3<8>;

struct ClosestPoints {
    Doubles3 point, barycentric;
    Doubles squared;
};

/// closest_on_triangle(), operation by operation: the same bits. Where that returns early, a lane
/// takes the first region that it is in.
HWY_INLINE ClosestPoints closest_on_triangles(Doubles3 p, Doubles3 a, Doubles3 b, Doubles3 c) {
    const Doubles zero(0.0), one(1.0);
    const Doubles3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const Doubles d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp),
                  d5 = dot(ab, cp), d6 = dot(ac, cp);
    const Doubles vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const Doubles e = d4 - d3, f = d5 - d6;

    const DoubleMask at_a = (d1 <= zero) & (d2 <= zero), at_b = (d3 >= zero) & (d4 <= d3),
                     at_c = (d6 >= zero) & (d5 <= d6);
    const DoubleMask on_ab = (vc <= zero) & (d1 >= zero) & (d3 <= zero) & (d1 - d3 > zero),
                     on_ac = (vb <= zero) & (d2 >= zero) & (d6 <= zero) & (d2 - d6 > zero),
                     on_bc = (va <= zero) & (e >= zero) & (f >= zero) & (e + f > zero);
    const Doubles sum = va + vb + vc;
    const DoubleMask face = sum > zero;

    const Doubles part = select(on_ab, d1, select(on_ac, d2, select(on_bc, e, va)));
    const Doubles whole = select(
        on_ab, d1 - d3, select(on_ac, d2 - d6, select(on_bc, e + f, select(face, sum, one))));
    const Doubles s = part / whole, rest = one - s;
    const Doubles area = select(face, sum, one);

    // from the last region to the first
    Doubles3 w{select(face, s, one), select(face, vb / area, zero), select(face, vc / area, zero)};
    const auto where = [&](DoubleMask m, Doubles x, Doubles y, Doubles z) {
        w = {select(m, x, w.x), select(m, y, w.y), select(m, z, w.z)};
    };
    where(on_bc, zero, rest, s);
    where(on_ac, rest, zero, s);
    where(on_ab, rest, s, zero);
    where(at_c, zero, zero, one);
    where(at_b, zero, one, zero);
    where(at_a, one, zero, zero);

    const Doubles3 point{a.x * w.x + b.x * w.y + c.x * w.z, a.y * w.x + b.y * w.y + c.y * w.z,
                         a.z * w.x + b.z * w.y + c.z * w.z};
    const Doubles3 gap = p - point;
    return {point, w, dot(gap, gap)};
}

/// Triangles whose nearest points are wanted, some vectors of them.
class Candidates {
  public:
    HWY_INLINE explicit Candidates(const Vec3d& p) : p_{p.x, p.y, p.z} {}

    /// Those of the sixteen whose bits are set; `first`: the number of the first.
    HWY_INLINE void add(const TriangleTree::Leaf& leaf, std::uint32_t bits, std::uint32_t first) {
        for (std::size_t lane = 0; lane < TriangleTree::kBoxes; lane += kPackLanes) {
            const Packing packing(mask_of(bits >> lane));
            const std::size_t to = count_ + std::popcount(bits & ((1u << lane) - 1));
            for (std::size_t c = 0; c < 9; ++c)
                packing.store(Pack::load(leaf.corner[c / 3][c % 3] + lane), corner_[c] + to);
            packing.store(Numbers::counting(first + static_cast<std::uint32_t>(lane)),
                          number_ + to);
        }
        count_ += static_cast<std::size_t>(std::popcount(bits));
    }
    /// Whether there may be no room for those of one more leaf.
    HWY_INLINE bool full() const { return count_ > kMost - TriangleTree::kBoxes; }

    /// Calls use(closest, number) for each whose squared distance is no more than `limit`, in
    /// order; then there are none.
    template <typename Use> HWY_INLINE void evaluate(double limit, Use&& use) {
        for (auto& numbers : corner_) // the last vector is read whole
            Pack(0.f).store_any(numbers + count_);
        for (std::size_t first = 0; first < count_; first += Doubles::kCount) {
            const auto corner = [&](std::size_t c) -> Doubles3 {
                return {Doubles::load(corner_[3 * c] + first),
                        Doubles::load(corner_[3 * c + 1] + first),
                        Doubles::load(corner_[3 * c + 2] + first)};
            };
            const ClosestPoints found = closest_on_triangles(p_, corner(0), corner(1), corner(2));
            std::uint32_t near = (found.squared <= Doubles(limit)).bits();
            if (count_ - first < Doubles::kCount)
                near &= (1u << (count_ - first)) - 1;
            if (near == 0)
                continue;
            alignas(64) double numbers[7][Doubles::kCount];
            found.point.x.store(numbers[0]);
            found.point.y.store(numbers[1]);
            found.point.z.store(numbers[2]);
            found.barycentric.x.store(numbers[3]);
            found.barycentric.y.store(numbers[4]);
            found.barycentric.z.store(numbers[5]);
            found.squared.store(numbers[6]);
            for (; near != 0; near &= near - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(near));
                ClosestPoint closest;
                closest.point = {numbers[0][i], numbers[1][i], numbers[2][i]};
                closest.barycentric = {numbers[3][i], numbers[4][i], numbers[5][i]};
                closest.squared = numbers[6][i];
                use(closest, number_[first + i]);
            }
        }
        count_ = 0;
    }

  private:
    static constexpr std::size_t kMost = 2 * TriangleTree::kBoxes;
    Doubles3 p_;
    std::size_t count_ = 0;
    float corner_[9][kMost + kPackLanes];
    std::uint32_t number_[kMost + kPackLanes];
};

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
