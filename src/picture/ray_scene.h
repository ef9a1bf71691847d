#pragma once

#include "mane/body.h"
#include "mane/curves.h"
#include "mane/vec.h"

#include <embree3/rtcore.h>

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// What a ray meets first.
struct RayHit {
    float distance = 0;
    std::uint32_t shape = kNothing; ///< in the order of adding
    std::uint32_t part = 0;         ///< triangle, or curve (strand)
    Vec3 point;
    Vec3 direction; ///< a mesh's smooth unit normal, a curve's unit tangent toward the tip

    static constexpr std::uint32_t kNothing = 0xffffffffu;
    explicit operator bool() const { return shape != kNothing; }
};

/// Curves and meshes for rays: Embree behind one door.
class RayScene {
  public:
    RayScene();
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Each returns the shape's number. What is given is copied.
    std::uint32_t add_ribbons(const Curves& curves, float width_scale);
    std::uint32_t add_mesh(std::span<const Vec3> vertices,
                           std::span<const std::array<std::uint32_t, 3>> triangles);
    /// After the last shape, before the first ray.
    void commit();

    RayHit first_hit(const Vec3& from, const Vec3& direction) const;
    bool blocked(const Vec3& from, const Vec3& direction) const;

  private:
    struct Shape {
        bool curves = false;
        std::vector<std::uint32_t> strand_of; // curves: per Catmull-Rom piece
    };
    std::uint32_t attach(RTCGeometry geometry, Shape shape);

    RTCDevice device_;
    RTCScene scene_;
    std::vector<Shape> shapes_;
};

} // namespace mane
