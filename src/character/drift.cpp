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
    for (const TriangleTree::Group& group : tree.groups()) {
        first_.push_back(static_cast<std::uint32_t>(vertex_.size()));
        for (std::uint32_t t : tree.order().subspan(group.first, group.count))
            vertex_.insert(vertex_.end(), triangles[t].begin(), triangles[t].end());
        const auto begin = vertex_.begin() + first_.back();
        std::sort(begin, vertex_.end());
        vertex_.erase(std::unique(begin, vertex_.end()), vertex_.end());
    }
    first_.push_back(static_cast<std::uint32_t>(vertex_.size()));
    for (auto* numbers : {&x_, &y_, &z_})
        numbers->resize(vertex_.size());
}

void Drift::follow(std::span<const Vec3> vertices, std::span<const RigidFrame> frames,
                   bool further) {
    for (std::size_t i = 0; i < vertex_.size(); ++i) {
        const Vec3& p = vertices[vertex_[i]];
        x_[i] = p.x, y_[i] = p.y, z_[i] = p.z;
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
    const Vec3 x(frame.x), y(frame.y), z(frame.z), o(frame.origin);
    std::vector<float>&before_x = local_x_[f], &before_y = local_y_[f], &before_z = local_z_[f];
    before_x.resize(vertex_.size());
    before_y.resize(vertex_.size());
    before_z.resize(vertex_.size());
    OfGroups farthest{};
    for (std::size_t g = 0; g + 1 < first_.size(); ++g) {
        float squared = 0;
        for (std::size_t i = first_[g]; i < first_[g + 1]; ++i) {
            const float px = x_[i] - o.x, py = y_[i] - o.y, pz = z_[i] - o.z;
            const float lx = x.x * px + x.y * py + x.z * pz, ly = y.x * px + y.y * py + y.z * pz,
                        lz = z.x * px + z.y * py + z.z * pz;
            const float dx = lx - before_x[i], dy = ly - before_y[i], dz = lz - before_z[i];
            const float size = dx * dx + dy * dy + dz * dz;
            squared = squared > size ? squared : size;
            before_x[i] = lx, before_y[i] = ly, before_z[i] = lz;
        }
        farthest[g] = std::sqrt(squared) + kRounding;
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
