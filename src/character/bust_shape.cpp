#include "character/bust_shape.h"

#include "character/distance.h"

namespace mane {
namespace {

// One half, x ≥ 0, as the other mirrors it. Shapes that meet the plane x = 0 meet it at a right
// angle: no crease there.

double skull(const Vec3d& p) {
    const double cranium = ellipsoid(p, {0, 1.566, -0.014}, {0.0725, 0.084, 0.0925});
    const double forehead = ellipsoid(p, {0, 1.572, 0.016}, {0.060, 0.056, 0.0665});
    return smooth_union(cranium, forehead, 0.030);
}

double face(const Vec3d& p) {
    const double middle = ellipsoid(p, {0, 1.515, 0.026}, {0.0575, 0.072, 0.058});
    const double mouth = ellipsoid(p, {0, 1.473, 0.046}, {0.036, 0.036, 0.041});
    const double jaw = cone(p, {0.043, 1.488, 0.006}, 0.013, {0.012, 1.4475, 0.062}, 0.0125);
    const double chin = ellipsoid(p, {0, 1.4455, 0.069}, {0.017, 0.0145, 0.0145});
    const double cheekbone = ellipsoid(p, {0.042, 1.519, 0.048}, {0.020, 0.016, 0.022});
    double d = smooth_union(middle, mouth, 0.028);
    d = smooth_union(d, jaw, 0.026);
    d = smooth_union(d, chin, 0.020);
    return smooth_union(d, cheekbone, 0.024);
}

double brow(const Vec3d& p) {
    return cone(p, {0.010, 1.5555, 0.0765}, 0.007, {0.041, 1.559, 0.0605}, 0.006);
}

double eye_socket(const Vec3d& p) {
    return ellipsoid(p, {0.0315, 1.541, 0.0865}, {0.017, 0.0105, 0.0145});
}

double eye(const Vec3d& p) {
    return ellipsoid(p, {0.0315, 1.5395, 0.0655}, {0.0145, 0.0105, 0.0115});
}

double nose(const Vec3d& p) {
    const double bridge = cone(p, {0, 1.549, 0.0790}, 0.0065, {0, 1.504, 0.0970}, 0.0075);
    const double tip = ball(p, {0, 1.5, 0.0985}, 0.0088);
    const double wing = ellipsoid(p, {0.0100, 1.4985, 0.0885}, {0.0068, 0.0070, 0.0100});
    return smooth_union(smooth_union(bridge, tip, 0.010), wing, 0.012);
}

double lips(const Vec3d& p) {
    const double upper = ellipsoid(p, {0, 1.4765, 0.0825}, {0.0215, 0.0052, 0.0098});
    const double lower = ellipsoid(p, {0, 1.4670, 0.0815}, {0.0185, 0.0058, 0.0095});
    return smooth_union(upper, lower, 0.0025);
}

double neck(const Vec3d& p) {
    const double column = cone(p, {0, 1.340, -0.045}, 0.056, {0, 1.500, -0.020}, 0.0465);
    const double muscle = cone(p, {0.047, 1.492, -0.022}, 0.009, {0.013, 1.348, 0.004}, 0.008);
    const double slope = cone(p, {0.020, 1.425, -0.058}, 0.026, {0.128, 1.335, -0.048}, 0.020);
    return smooth_union(smooth_union(column, muscle, 0.024), slope, 0.050);
}

double torso(const Vec3d& p) {
    const double ribs = ellipsoid(p, {0, 1.180, -0.032}, {0.130, 0.180, 0.092});
    const double girdle = cone(p, {0, 1.312, -0.042}, 0.042, {0.145, 1.304, -0.042}, 0.033);
    const double shoulder = ellipsoid(p, {0.156, 1.270, -0.042}, {0.036, 0.072, 0.042});
    const double collarbone = cone(p, {0.016, 1.334, 0.006}, 0.008, {0.128, 1.336, -0.018}, 0.006);
    const double breast = ellipsoid(p, {0.066, 1.180, 0.036}, {0.054, 0.060, 0.046});
    double d = smooth_union(ribs, girdle, 0.060);
    d = smooth_union(d, shoulder, 0.050);
    d = smooth_union(d, collarbone, 0.026);
    return smooth_union(d, breast, 0.055);
}

double pedestal_cut(const Vec3d& p) {
    return 1.105 - p.y;
}

double half_bust(const Vec3d& p) {
    double head = smooth_union(skull(p), face(p), 0.032);
    head = smooth_union(head, brow(p), 0.014);
    head = smooth_difference(head, eye_socket(p), 0.014);
    head = smooth_union(head, eye(p), 0.004);
    head = smooth_union(head, nose(p), 0.013);
    head = smooth_union(head, lips(p), 0.005);
    head = smooth_union(head, ear_distance(p), 0.010);
    const double body = smooth_union(neck(p), torso(p), 0.045);
    return smooth_intersection(smooth_union(head, body, 0.018), pedestal_cut(p), 0.030);
}

} // namespace

// A leaning, slightly flaring dish.
double ear_distance(const Vec3d& p) {
    const Vec3d centre{0.0705, 1.527, -0.016};
    Vec3d d = Vec3d(std::fabs(p.x), p.y, p.z) - centre;
    d.z += 0.25 * d.y; // leans back
    d.x += 0.40 * d.z; // its rear edge stands off the skull
    const double shell = ellipsoid(d, {}, {0.0090, 0.0300, 0.0175});
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
