#include "character/bust_shape.h"
#include "character/distance.h"
#include "character/ease.h"
#include "character/polygonise.h"
#include "character/remesh.h"
#include "mane/character.h"

namespace mane {
namespace {

// Finer where the shape is: eyes, nose and lips, then the ears, then the head; coarse on the chest.
double bust_edge_length(const Vec3d& p) {
    const Vec3d q{std::fabs(p.x), p.y, p.z};
    const double features = ellipsoid(q, {0, 1.505, 0.095}, {0.042, 0.058, 0.030});
    const double ear = ball(q, {0.075, 1.527, -0.016}, 0.026);
    const double head = ellipsoid(q, {0, 1.54, -0.005}, {0.085, 0.115, 0.11});
    const double at_features = 0.0034 + 0.15 * std::max(features, 0.0);
    const double at_ear = 0.0052 + 0.15 * std::max(ear, 0.0);
    const double at_head = 0.0100 + 0.15 * std::max(head, 0.0);
    return std::min({at_features, at_ear, at_head, 0.0200});
}

// A band across the neck over which a vertex passes from one bone to the next. It rises from the
// throat to the nape, as jaw and collar do: the chin goes with the head, the trapezius with the
// chest. Its slope differs before and behind the neck's axis, or it would cut through the occiput.
struct Band {
    double height, axis; // [m] y and z of its middle
    double slope_before, slope_behind;
    double width; // [m] along y

    double share(const Vec3d& p) const {
        const double z = p.z - axis;
        const double rise = -smooth_union(-slope_before * z, -slope_behind * z, 0.02);
        return ease((p.y - height + rise) / width + 0.5).value;
    }
};
constexpr Band kChestToNeck{1.392, -0.032, 0.55, 0.45, 0.085};
constexpr Band kNeckToHead{1.455, -0.012, 0.75, 0.30, 0.078};

Skin bust_skin(const Mesh& mesh) {
    Skin skin;
    for (const Vec3& vertex : mesh.vertices) {
        const Vec3d p(vertex);
        const auto neck = static_cast<float>(kChestToNeck.share(p));
        const auto head = static_cast<float>(kNeckToHead.share(p)) * neck;
        skin.bones.push_back({kChestBone, kNeckBone, kHeadBone, kHeadBone});
        skin.weights.push_back({1 - neck, neck - head, head, 0});
    }
    return skin;
}

Body shape_bust() {
    Body bust;
    bust.name = "bust";
    const Mesh coarse = polygonise(bust_distance, bust_box(), 0.006);
    bust.mesh = remesh(coarse, {bust_distance, bust_edge_length}, 8);
    bust.skin = bust_skin(bust.mesh);
    bust.head_bone = kHeadBone;
    return bust;
}

} // namespace

BustJoints bust_joints() {
    return {{0, 1.20, -0.06}, {0, 1.385, -0.048}, {0, 1.495, -0.018}};
}

// There is one bust. To shape it takes longer than to comb it, which a page does whenever a style
// changes.
Body make_bust() {
    static const Body bust = shape_bust();
    return bust;
}

} // namespace mane
