#pragma once

#include "mane/vec.h"

#include <cstdint>
#include <vector>

namespace mane {

/// Where a wisp is rooted: a point of a scalp triangle, and offsets in that triangle's own frame
/// (first axis along its first edge, second its normal, third their cross product), so that x₀ and
/// x₁ ride the skin.
struct WispRoot {
    std::uint32_t triangle = 0; ///< of the first body's mesh
    Vec3 barycentric;           ///< sum 1
    Vec3 inside;                ///< [m] x₀, inside the head
    Vec3 outside;               ///< [m] x₁, just outside the scalp
    Vec3 first_axis; ///< unit, across the wisp: direction of the first half line of section 0

    bool operator==(const WispRoot&) const = default;
};

/// Hair at rest: what a style or an artist's strands become, and all that the step needs to know of
/// it. Wisp w owns the sections first_section[w] … first_section[w+1]−1, from x₀ (inside the head)
/// to the tip. Segment i joins sections i and i+1 and is stored at i; joint i is the bend at
/// section i.
struct Groom {
    std::uint32_t envelope_points = 4; ///< K, per section

    // per wisp
    std::vector<std::uint32_t> first_section; ///< wisps + 1 entries
    std::vector<WispRoot> roots;
    std::vector<std::uint32_t> strands; ///< strands drawn in the wisp
    std::vector<float> thickness_power; ///< [1] M3

    // per section: the designed shape, in the first body's rest pose
    std::vector<Vec3> position;       ///< [m]
    std::vector<float> radius;        ///< [m] sections × K, along the half lines
    std::vector<float> skeleton_mass; ///< [kg] of the skeleton point
    std::vector<float> envelope_mass; ///< [kg] of each envelope point

    // springs of the skeleton
    std::vector<float> stretch_stiffness; ///< [N] EA of segment i
    std::vector<float> stretch_damping;   ///< [N·s/m] of segment i
    std::vector<float> rest_length;       ///< [m] of segment i (M44)
    std::vector<float> bend_stiffness;    ///< [N·m/rad] of joint i at its rest thickness
    std::vector<float> bend_damping;      ///< [N·m·s/rad] of joint i
    std::vector<float>
        rest_curvature_u; ///< [rad] of joint i, along the section's first axis (M2, M44)
    std::vector<float> rest_curvature_v; ///< [rad] of joint i, along its second axis

    // springs of the envelope, per section
    std::vector<float> radial_stiffness; ///< [N/m] k₀
    std::vector<float> radial_damping;   ///< [N·s/m]
    std::vector<float> ring_stiffness;   ///< [N/m]
    std::vector<float> ring_damping;     ///< [N·s/m]
    std::vector<float>
        rest_radius; ///< [m] sections × K: natural length of the radial springs (M44)
    std::vector<float>
        ring_length; ///< [m] sections × K: natural length from envelope point k to k+1

    std::size_t wisp_count() const { return roots.size(); }
    std::size_t section_count() const { return position.size(); }
    /// Sections of wisp w, x₀ included: its simulated segments are two fewer.
    std::uint32_t sections(std::size_t w) const { return first_section[w + 1] - first_section[w]; }
};

} // namespace mane
