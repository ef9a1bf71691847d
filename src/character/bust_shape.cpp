#include "character/bust_shape.h"

#include "character/distance.h"

namespace mane {
namespace {

// One half, x ≥ 0, as the other mirrors it. Shapes that meet the plane x = 0 meet it at a right
// angle: no crease there.

double skull(const Vec3d& p) {
    const double cranium = ellipsoid(p, {0, 1.568, -0.016}, {0.0735, 0.082, 0.0920});
    const double forehead = ellipsoid(p, {0, 1.576, 0.014}, {0.0600, 0.054, 0.0655});
    return smooth_union(cranium, forehead, 0.030);
}

double face(const Vec3d& p) {
    const double middle = ellipsoid(p, {0, 1.517, 0.024}, {0.0580, 0.070, 0.0580});
    const double mouth = ellipsoid(p, {0, 1.474, 0.046}, {0.0330, 0.036, 0.0395});
    const double jaw = cone(p, {0.041, 1.487, 0.006}, 0.012, {0.010, 1.4470, 0.061}, 0.0125);
    const double chin = ellipsoid(p, {0, 1.4460, 0.0690}, {0.0160, 0.0140, 0.0140});
    const double cheekbone = ellipsoid(p, {0.0390, 1.5160, 0.0500}, {0.0190, 0.0150, 0.0210});
    double d = smooth_union(middle, mouth, 0.030);
    d = smooth_union(d, jaw, 0.028);
    d = smooth_union(d, chin, 0.020);
    return smooth_union(d, cheekbone, 0.028);
}

double brow(const Vec3d& p) {
    const double inner = cone(p, {0.012, 1.5545, 0.0765}, 0.0060, {0.030, 1.5590, 0.0700}, 0.0060);
    const double outer = cone(p, {0.030, 1.5590, 0.0700}, 0.0060, {0.045, 1.5530, 0.0560}, 0.0045);
    return smooth_union(inner, outer, 0.006);
}

double eye_socket(const Vec3d& p) {
    return ellipsoid(p, {0.0310, 1.5415, 0.0880}, {0.0175, 0.0110, 0.0150});
}

// The ball under closed lids, and the edge where they meet.
double eye(const Vec3d& p) {
    const double lids = ellipsoid(p, {0.0310, 1.5395, 0.0655}, {0.0155, 0.0110, 0.0125});
    const double lashes =
        cone(p, {0.0190, 1.5365, 0.0700}, 0.0020, {0.0310, 1.5345, 0.0745}, 0.0026);
    const double lashes_out =
        cone(p, {0.0310, 1.5345, 0.0745}, 0.0026, {0.0440, 1.5375, 0.0655}, 0.0020);
    return smooth_union(lids, smooth_union(lashes, lashes_out, 0.004), 0.004);
}

double nose(const Vec3d& p) {
    const double bridge = cone(p, {0, 1.550, 0.0785}, 0.0060, {0, 1.505, 0.0960}, 0.0070);
    const double tip = ball(p, {0, 1.5005, 0.0980}, 0.0080);
    const double wing = ellipsoid(p, {0.0095, 1.4985, 0.0885}, {0.0062, 0.0062, 0.0095});
    const double base = cone(p, {0, 1.4985, 0.0960}, 0.0050, {0, 1.4945, 0.0830}, 0.0045);
    const double ridge = smooth_union(smooth_union(bridge, tip, 0.010), base, 0.006);
    return smooth_union(ridge, wing, 0.010);
}

double lips(const Vec3d& p) {
    const double upper = cone(p, {0, 1.4774, 0.0858}, 0.0045, {0.0215, 1.4732, 0.0778}, 0.0028);
    const double lower = cone(p, {0, 1.4664, 0.0846}, 0.0056, {0.0185, 1.4694, 0.0778}, 0.0032);
    return smooth_union(upper, lower, 0.0016);
}

double neck(const Vec3d& p) {
    const double column = cone(p, {0, 1.340, -0.045}, 0.0540, {0, 1.500, -0.022}, 0.0455);
    const double muscle = cone(p, {0.046, 1.492, -0.024}, 0.009, {0.013, 1.348, 0.002}, 0.008);
    const double slope = cone(p, {0.018, 1.425, -0.058}, 0.026, {0.128, 1.333, -0.048}, 0.020);
    return smooth_union(smooth_union(column, muscle, 0.024), slope, 0.050);
}

double torso(const Vec3d& p) {
    const double ribs = ellipsoid(p, {0, 1.215, -0.036}, {0.127, 0.165, 0.086});
    const double girdle = cone(p, {0, 1.312, -0.042}, 0.040, {0.142, 1.304, -0.044}, 0.033);
    const double shoulder = ellipsoid(p, {0.152, 1.275, -0.044}, {0.034, 0.064, 0.039});
    const double collarbone = cone(p, {0.016, 1.334, 0.004}, 0.008, {0.126, 1.334, -0.020}, 0.006);
    const double breast = ellipsoid(p, {0.060, 1.187, 0.022}, {0.048, 0.054, 0.042});
    double d = smooth_union(ribs, girdle, 0.060);
    d = smooth_union(d, shoulder, 0.060);
    d = smooth_union(d, collarbone, 0.026);
    return smooth_union(d, breast, 0.060);
}

double pedestal_cut(const Vec3d& p) {
    return 1.115 - p.y;
}

// The parts in the order in which their fillets are laid. A part further away than its fillet is
// wide changes nothing and is skipped: the box bounds in front tell it cheaply.

double with_features(double head, const Vec3d& p) {
    const double behind_features = 0.051 - p.z;
    if (behind_features > head + 0.014)
        return head;
    double d = smooth_union(head, brow(p), 0.014);
    d = smooth_difference(d, eye_socket(p), 0.014);
    d = smooth_union(d, eye(p), 0.004);
    d = smooth_union(d, nose(p), 0.013);
    return smooth_union(d, lips(p), 0.005);
}

double head(const Vec3d& p) {
    const double bald = smooth_union(skull(p), face(p), 0.032);
    return smooth_union(with_features(bald, p), ear_distance(p), 0.008);
}

double half_bust(const Vec3d& p) {
    const double fillet = 0.018;
    const double under_head = 1.428 - p.y, over_body = p.y - 1.546;
    double d = 0;
    if (over_body > 0) {
        d = head(p);
        if (over_body < d + fillet)
            d = smooth_union(d, smooth_union(neck(p), torso(p), 0.045), fillet);
    } else {
        d = smooth_union(neck(p), torso(p), 0.045);
        if (under_head < d + fillet)
            d = smooth_union(d, head(p), fillet);
    }
    return smooth_intersection(d, pedestal_cut(p), 0.030);
}

} // namespace

// A leaning, slightly flaring dish.
double ear_distance(const Vec3d& p) {
    const Vec3d centre{0.0705, 1.527, -0.016};
    Vec3d d = Vec3d(std::fabs(p.x), p.y, p.z) - centre;
    d.z += 0.25 * d.y; // leans back
    d.x += 0.40 * d.z; // its rear edge stands off the skull
    const double shell = ellipsoid(d, {}, {0.0095, 0.0290, 0.0175});
    const double hollow = ellipsoid(d, {0.0110, 0.003, 0.001}, {0.0060, 0.017, 0.0090});
    return smooth_difference(shell, hollow, 0.006);
}

double bust_distance(const Vec3d& p) {
    return half_bust({std::fabs(p.x), p.y, p.z});
}

Box bust_box() {
    return {{-0.25, 1.07, -0.18}, {0.25, 1.68, 0.16}};
}

} // namespace mane
