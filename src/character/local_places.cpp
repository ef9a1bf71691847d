#include "character/local_places.h"

// This file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "character/local_places.cpp"
#include <hwy/foreach_target.h>

#include "base/pack-inl.h"
#include "base/reals-inl.h"

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace mane::HWY_NAMESPACE {

using Doubles = Reals<8>;
using Corners = std::array<std::uint32_t, 3>;

/// Fills what the places are compared by. Behind the last, a vector's worth of none's.
void fill(std::span<const Corners> triangles, std::span<const SurfacePlace> places,
          PlaceRows& rows) {
    const std::size_t behind = places.size() + kPackLanes;
    if (rows.squared.size() < behind)
        rows.resize(2 * behind);
    for (std::size_t n = 0; n < places.size(); ++n) {
        rows.squared[n] = places[n].closest.squared;
        for (std::size_t c = 0; c < 3; ++c)
            rows.corner[c][n] = triangles[places[n].triangle][c];
    }
    std::fill_n(rows.squared.begin() + static_cast<std::ptrdiff_t>(places.size()), kPackLanes,
                std::numeric_limits<double>::infinity());
}

/// Which of a Pack of triangles from `first` on have a vertex.
HWY_INLINE Mask have(const PlaceRows& rows, std::size_t first, Numbers vertex) {
    const auto corner = [&](std::size_t c) {
        return Numbers::load_any(rows.corner[c].data() + first) == vertex;
    };
    return either(corner(0), either(corner(1), corner(2)));
}

/// Which of them are nearer than a squared distance.
HWY_INLINE std::uint32_t nearer(const PlaceRows& rows, std::size_t first, double squared) {
    std::uint32_t bits = 0;
    for (std::size_t lane = 0; lane < kPackLanes; lane += Doubles::kCount)
        bits |= (Doubles::load(rows.squared.data() + first + lane) < Doubles(squared)).bits()
                << lane;
    return bits;
}

/// Whether no other triangle that has the edge or corner where a place is comes nearer.
HWY_INLINE bool local(const Corners& corners, const ClosestPoint& closest, const PlaceRows& rows,
                      std::size_t count) {
    const Vec3d& w = closest.barycentric;
    if (w.x != 0 && w.y != 0 && w.z != 0)
        return true;
    const Numbers a(w.x != 0   ? corners[0]
                    : w.y != 0 ? corners[1]
                               : corners[2]),
        b(w.z != 0   ? corners[2]
          : w.y != 0 ? corners[1]
                     : corners[0]);
    const double limit = closest.squared * (1 - 1e-9);
    for (std::size_t first = 0; first < count; first += kPackLanes)
        if ((bits_of(both(have(rows, first, a), have(rows, first, b))) &
             nearer(rows, first, limit)) != 0)
            return false;
    return true;
}

void keep_local(std::span<const Corners> triangles, PlaceRows& rows,
                std::vector<SurfacePlace>& places) {
    const std::size_t count = places.size();
    if (count < 2)
        return;
    fill(triangles, places, rows);
    std::size_t kept = 0;
    for (std::size_t n = 0; n < count; ++n)
        if (local(triangles[places[n].triangle], places[n].closest, rows, count))
            places[kept++] = places[n];
    places.resize(kept);
}

KeepLocal* kept_local() {
    return keep_local;
}

} // namespace mane::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "base/instruction_set.h"

namespace mane {

HWY_EXPORT(kept_local);

KeepLocal* keep_local_for(const std::string& name) {
    const ChosenInstructionSet chosen(instruction_set(name));
    return HWY_DYNAMIC_DISPATCH(kept_local)();
}

} // namespace mane
#endif
