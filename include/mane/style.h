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

/// A hairstyle, as a stylist would say it: where it grows, how it is cut, parted and combed, how
/// wide its wisps are.
struct StyleDesc {
    std::uint32_t wisps = 56;   ///< [1] wisps on the head, spread evenly over the scalp
    float segments = 7.7f;      ///< [1] simulated segments per wisp, mean; longer wisps have more
    float nape_length = 0.34f;  ///< [m] length of the lowest wisps
    float crown_length = 0.46f; ///< [m] length of the highest wisps
    float length_variation = 0.06f; ///< [1] largest share by which a wisp is shorter at random
    float root_radius = 0.026f;     ///< [m] half width of a wisp at its root
    float radius = 0.03f;           ///< [m] half width of a wisp where it is widest
    float tip_radius = 0.017f;      ///< [m] half width of a wisp at its tip
    float widest = 0.4f;            ///< [1] where along a wisp it is widest
    float thickness = 0.5f;  ///< [1] depth of a wisp, away from the head, relative to its width
    float hairline = 0.004f; ///< [m] roots keep this distance from the edge of the scalp
    float parting = 0; ///< [m] the parting line's distance from the middle, to the character's left
    float parting_width = 0.004f; ///< [m] no wisp is rooted on the line
    float comb_side = 1;    ///< [1] how much hair is combed away from the parting; 0: not at all
    float comb_back = 0.8f; ///< [1] how much hair in front is combed back from the face
    float front = 0.5f;    ///< [1] hair rooted before this share of the scalp, 0 at its rear, falls
                           ///< over the shoulders to the front
    float root_angle = 25; ///< [deg] between a wisp and the scalp where it leaves it
    float drape = 0.02f;   ///< [m] way over which a wisp gives in to the comb and to gravity
    float volume = 0.012f; ///< [m] how far the highest wisps stand off the ones below
    float variation = 8;   ///< [deg] largest random turn of a wisp at its root
};

/// All that decides on a head of hair before it moves.
struct HairDesc {
    StyleDesc style;
    SkeletonDesc skeleton;
    EnvelopeDesc envelope;
    StrandDesc strands;
};

/// Lays a style over a wearer in its rest pose: roots spread evenly over `scalp` (triangles of the
/// wearer's mesh), each wisp combed from its root and draped under gravity over head and shoulders,
/// outside of the body everywhere. The strands are shared evenly. A wisp that would fall out of its
/// design (M44) gets a longer bending length. `seed`: another number, other roots and variations.
/// Throws InputError for a style that cannot be laid.
std::vector<WispDesign> lay_style(const HairDesc& hair, const Body& wearer,
                                  std::span<const std::uint32_t> scalp, std::uint32_t seed = 1);

/// Gives laid wisps the springs of `hair`, as if they were laid for it: its style, its number of
/// strands and of envelope points are those that they were laid with. A tenth of the work.
void give_springs(std::span<WispDesign> wisps, const HairDesc& hair);

/// A straight wisp, for tests and examples.
struct StraightWisp {
    std::uint32_t triangle = 0;   ///< of the wearer's mesh; the root is in its middle
    Vec3 direction = {0, -1, 0};  ///< from x₁ to the tip
    float length = 0.4f;          ///< [m] simulated: from x₁ to the tip
    std::uint32_t segments = 8;   ///< [1] simulated segments
    float depth = 0.01f;          ///< [m] x₀ and x₁ are this far under and above the triangle
    Ramp radius = {0.02f, 0.01f}; ///< [m] from x₁ to the tip
    std::uint32_t strands = 1000; ///< [1]
    SkeletonDesc skeleton = {};
    EnvelopeDesc envelope = {};
};
WispDesign design(const StraightWisp& wisp, const Mesh& wearer);

/// Something to hang wisps on: a tetrahedron with edges of `size` [m] around the origin. Triangle 0
/// faces down.
Body make_peg(float size = 0.05f);

} // namespace mane
