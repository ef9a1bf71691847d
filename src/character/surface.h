#pragma once

#include "base/bins.h"
#include "character/closing.h"
#include "character/drift.h"
#include "character/posed_surface.h"

namespace mane {

/// A body's closed surface over one detection block: its pose at the block's start and at its end.
/// Positions are floats in metres, relative to the world's origin. Every place between moves
/// linearly in time.
class Surface {
  public:
    /// `instruction_set`: "" for the machine's best; all give the same answers.
    explicit Surface(const Mesh& rest, const std::string& instruction_set = "");
    Surface(const Surface&) = delete; // its poses refer to its triangles
    Surface& operator=(const Surface&) = delete;

    /// Both ends at one pose: at the beginning, and when the world's origin has moved. `vertices`:
    /// the mesh's, posed. `frames`: where rigid parts of the body are, always the same ones; all
    /// answers are true whatever they are, and near them fewer questions are asked.
    void reset(std::span<const Vec3> vertices, std::span<const RigidFrame> frames = kAtRest);
    /// Goes on by one block: the end becomes the start, `vertices` [m] the pose `duration` [s]
    /// later.
    void advance(std::span<const Vec3> vertices, double duration,
                 std::span<const RigidFrame> frames = kAtRest);
    static constexpr RigidFrame kAtRest[1] = {};

    const PosedSurface& start() const { return poses_[was_reset_ ? 1 - start_ : start_]; }
    const PosedSurface& end() const { return poses_[1 - start_]; }
    double duration() const { return duration_; } ///< [s] of the block
    double fastest() const {
        return fastest_;
    } ///< [m/s] the highest speed of a vertex over the block

    const RigidFrame& start_frame(std::size_t f) const { return frames_[start_][f]; }
    const RigidFrame& end_frame(std::size_t f) const { return frames_[1 - start_][f]; }
    /// How far the surface strays from its frames over the block.
    const Drift& drift() const { return drift_; }
    /// Counts the blocks.
    std::uint64_t block() const { return block_; }
    /// Another number: what was known about the surface before its last block is known no longer.
    std::uint64_t jumps() const { return jumps_; }

    const ClosedMesh& mesh() const { return mesh_; }
    bool cap(std::uint32_t triangle) const { return triangle >= mesh_.own_triangles; }

    /// Normal at a place of the block's start, interpolated between the corners, unit. A corner at
    /// a crease keeps its triangle's own normal: a mean over a crease would lean a plane into the
    /// open space on its other side.
    Vec3d smooth_normal(const SurfacePlace& place) const;

    /// Carries a point along from start to end as if fixed to triangle `t`: exact where the surface
    /// moves rigidly.
    Vec3d carried_point(std::uint32_t t, const Vec3d& p) const;
    Vec3d carried_direction(std::uint32_t t, const Vec3d& d) const;

  private:
    void take(std::span<const Vec3> vertices);
    /// Whether the end is that pose.
    bool is_at(std::span<const Vec3> vertices, std::span<const RigidFrame> frames) const;
    void take_frames(std::size_t end, std::span<const RigidFrame> frames);
    void find_creases(std::span<const Vec3> rest);
    void sort_by_vertex();
    Vec3d vertex_normal(std::uint32_t v) const;

    ClosedMesh mesh_;
    std::vector<std::array<bool, 3>> crease_; // per triangle and corner
    std::vector<Vec3> closed_vertices_;       // the mesh's and the caps' centres
    Bins at_vertex_;                          // per vertex: places in triangles_at_
    std::vector<std::uint32_t> triangles_at_; // by vertex, rising
    std::array<PosedSurface, 2> poses_;
    std::array<std::array<RigidFrame, Drift::kFrames>, 2> frames_;
    Drift drift_;
    std::uint64_t block_ = 0, jumps_ = 0;
    bool was_reset_ = false; // then the end is both
    bool strayed_ = false;   // since the last block's end
    std::size_t start_ = 0;
    double duration_ = 0, fastest_ = 0;
};

} // namespace mane
