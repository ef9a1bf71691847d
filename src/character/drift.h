#pragma once

#include "base/four.h"
#include "character/rigid_frame.h"
#include "character/triangle_tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// How far the parts of a surface stray from its rigid frames as it goes from pose to pose: what is
/// known about the surface in a frame is known again in the next pose, but for so much.
///
/// The parts are groups of triangles that lie together, at most 64: sets of them fit into a word.
class Drift {
  public:
    static constexpr std::size_t kGroups = TriangleTree::kGroups;
    static constexpr std::size_t kFrames = 4; ///< at most

    Drift() = default;
    Drift(std::span<const std::array<std::uint32_t, 3>> triangles, const TriangleTree& tree);

    /// Goes on to the next pose of vertices and frames. `further`: what is told from now on is of
    /// this way and the one before together.
    void follow(std::span<const Vec3> vertices, std::span<const RigidFrame> frames, bool further);

    std::size_t frames() const { return frames_; }
    /// [m] No place of a group strayed farther from frame f over the last way.
    float of(std::size_t f, std::size_t group) const { return strayed_[f][group]; }
    float of_groups(std::size_t f, std::uint64_t groups) const;
    /// The same for any group.
    float of_any(std::size_t f) const { return any_[f]; }
    /// Of late, on average [m]: to choose a frame by.
    float habit(std::size_t f, std::uint64_t groups) const;

  private:
    struct FourPlaces {
        Four x{}, y{}, z{};
    };
    using OfGroups = std::array<float, kGroups>;
    OfGroups strayed(std::size_t f, const RigidFrame& frame);

    std::size_t frames_ = 0;
    std::vector<std::array<std::uint32_t, 4>> vertex_; // of all groups, group after group
    std::vector<std::uint32_t> first_; // place of each group's first vertices, and the end
    std::vector<FourPlaces> now_;      // of the vertices
    std::array<std::vector<FourPlaces>, kFrames> local_; // in each frame, before
    std::array<OfGroups, kFrames> strayed_{}, habit_{};
    std::array<float, kFrames> any_{}, quiet_{};
    std::array<std::uint64_t, kFrames> loud_{}; // groups that strayed by more than quiet_
};

} // namespace mane
