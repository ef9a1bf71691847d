#include "character/drift.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace mane {
namespace {

/// [m] over the rounding of a place in a frame, in single precision within metres of the origin.
constexpr float kRounding = 1e-6f;
/// [m] Groups that stray by no more than this need not be told apart.
constexpr float kQuiet = 4e-6f;
constexpr float kHabit = 0.1f; // weight of the last way in the mean

} // namespace

Drift::Drift(std::span<const std::array<std::uint32_t, 3>> triangles, const TriangleTree& tree) {
    std::vector<std::uint32_t> of_group;
    for (const TriangleTree::Group& group : tree.groups()) {
        of_group.clear();
        for (std::uint32_t t : tree.order().subspan(group.first, group.count))
            of_group.insert(of_group.end(), triangles[t].begin(), triangles[t].end());
        std::sort(of_group.begin(), of_group.end());
        of_group.erase(std::unique(of_group.begin(), of_group.end()), of_group.end());
        of_group.resize((of_group.size() + 3) / 4 * 4, of_group.back());
        first_.push_back(static_cast<std::uint32_t>(vertex_.size()));
        for (std::size_t i = 0; i < of_group.size(); i += 4)
            vertex_.push_back({of_group[i], of_group[i + 1], of_group[i + 2], of_group[i + 3]});
    }
    first_.push_back(static_cast<std::uint32_t>(vertex_.size()));
    now_.resize(vertex_.size());
}

void Drift::follow(std::span<const Vec3> vertices, std::span<const RigidFrame> frames,
                   bool further) {
    for (std::size_t i = 0; i < vertex_.size(); ++i) {
        const Vec3 &a = vertices[vertex_[i][0]], &b = vertices[vertex_[i][1]],
                   &c = vertices[vertex_[i][2]], &d = vertices[vertex_[i][3]];
        now_[i] = {Four{a.x, b.x, c.x, d.x}, Four{a.y, b.y, c.y, d.y}, Four{a.z, b.z, c.z, d.z}};
    }
    frames_ = std::min(frames.size(), kFrames);
    for (std::size_t f = 0; f < frames_; ++f) {
        const OfGroups now = strayed(f, frames[f]);
        any_[f] = quiet_[f] = 0;
        loud_[f] = 0;
        for (std::size_t g = 0; g + 1 < first_.size(); ++g) {
            strayed_[f][g] = further ? strayed_[f][g] + now[g] : now[g];
            habit_[f][g] += (now[g] - habit_[f][g]) * kHabit;
            any_[f] = std::max(any_[f], strayed_[f][g]);
            if (strayed_[f][g] > kQuiet)
                loud_[f] |= std::uint64_t{1} << g;
            else
                quiet_[f] = std::max(quiet_[f], strayed_[f][g]);
        }
    }
}

Drift::OfGroups Drift::strayed(std::size_t f, const RigidFrame& frame) {
    const auto along = [](const Vec3d& axis) -> FourPlaces {
        const Vec3 a(axis);
        return {four(a.x), four(a.y), four(a.z)};
    };
    const auto times = [](const FourPlaces& a, const FourPlaces& b) {
        return a.x * b.x + a.y * b.y + a.z * b.z;
    };
    const FourPlaces x = along(frame.x), y = along(frame.y), z = along(frame.z),
                     origin = along(frame.origin);
    local_[f].resize(vertex_.size());
    OfGroups farthest{};
    for (std::size_t g = 0; g + 1 < first_.size(); ++g) {
        Four squared{};
        for (std::size_t i = first_[g]; i < first_[g + 1]; ++i) {
            const FourPlaces& p = now_[i];
            FourPlaces& before = local_[f][i];
            const FourPlaces arm{p.x - origin.x, p.y - origin.y, p.z - origin.z};
            const FourPlaces local{times(x, arm), times(y, arm), times(z, arm)};
            const FourPlaces way{local.x - before.x, local.y - before.y, local.z - before.z};
            squared = larger(squared, times(way, way));
            before = local;
        }
        farthest[g] =
            std::sqrt(std::max({squared[0], squared[1], squared[2], squared[3]})) + kRounding;
    }
    return farthest;
}

float Drift::of_groups(std::size_t f, std::uint64_t groups) const {
    float farthest = quiet_[f];
    for (std::uint64_t left = groups & loud_[f]; left != 0; left &= left - 1)
        farthest =
            std::max(farthest, strayed_[f][static_cast<std::size_t>(std::countr_zero(left))]);
    return farthest;
}

float Drift::habit(std::size_t f, std::uint64_t groups) const {
    float most = 0;
    for (; groups != 0; groups &= groups - 1)
        most = std::max(most, habit_[f][static_cast<std::size_t>(std::countr_zero(groups))]);
    return most;
}

} // namespace mane
