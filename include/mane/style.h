#pragma once

#include "mane/body.h"
#include "mane/desc.h"
#include "mane/groom.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mane {

/// One wisp as it is drawn by a stylist, before it has masses and springs. Points in the wearer's
/// rest pose.
struct WispDesign {
    std::uint32_t triangle = 0;   ///< of the wearer's mesh, where the wisp is rooted
    Vec3 barycentric = {1, 0, 0}; ///< the root in that triangle, sum 1
    Vec3 first_axis = {1, 0, 0};  ///< unit, across the wisp: first half line of section 0 (M8)
    std::vector<Vec3> position;   ///< [m] sections, x₀ (inside the head) to the tip; at least 3
    std::vector<float> radius;    ///< [m] sections × K, over 0
    std::uint32_t strands = 1;    ///< [1] strands drawn in the wisp; its mass counts them
    SkeletonDesc skeleton;
    EnvelopeDesc envelope;
};

/// Hair whose springs alone carry it in the designed shape (M44): masses and stiffnesses from the
/// physical parameters of each wisp, rest shape in closed form. Throws InputError, by wisp, for a
/// design that cannot be (fewer than 3 sections, K under 3 or not the same for all, a fold), and
/// for a balance that is not stable, with the bending length that would do.
Groom make_groom(std::span<const WispDesign> wisps, const Mesh& wearer,
                 const Vec3& gravity = {0, -9.81f, 0});

/// A straight wisp, for tests and examples.
struct StraightWisp {
    std::uint32_t triangle = 0;   ///< of the wearer's mesh; the root is in its middle
    Vec3 direction = {0, -1, 0};  ///< from x₁ to the tip
    float length = 0.4f;          ///< [m] simulated: from x₁ to the tip
    std::uint32_t segments = 8;   ///< [1] simulated segments
    float depth = 0.01f;          ///< [m] x₀ and x₁ are this far under and above the triangle
    Ramp radius = {0.02f, 0.01f}; ///< [m] from x₁ to the tip
    std::uint32_t strands = 1000; ///< [1]
    SkeletonDesc skeleton;
    EnvelopeDesc envelope;
};
WispDesign design(const StraightWisp& wisp, const Mesh& wearer);

/// Something to hang wisps on: a tetrahedron with edges of `size` [m] around the origin. Triangle 0
/// faces down.
Body make_peg(float size = 0.05f);

} // namespace mane
