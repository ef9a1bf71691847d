#include "groom/grow.h"

#include "base/functions.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr double kStride = 0.004; // [m]
constexpr double kRootHeight =
    0.006; // [m] of x₁ over the scalp: outside, and over the contact threshold
constexpr double kSkin =
    0.006; // [m] left between hair and skin: the contact threshold and the sagitta of a chord

constexpr int kSmoothings = 30;     // over some 15 mm
constexpr double kCombReach = 0.05; // [m] over the lying hair: farther out it hangs freely

double smooth_step(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

Vec3d across(const Vec3d& v, const Vec3d& unit) {
    return v - unit * dot(v, unit);
}

} // namespace

double wisp_radius(const StyleDesc& style, double s) {
    const double w = style.widest;
    if (s <= w)
        return style.root_radius + (double{style.radius} - style.root_radius) * smooth_step(s / w);
    return style.tip_radius +
           (double{style.radius} - style.tip_radius) * smooth_step((1 - s) / (1 - w));
}

Vec3d Grower::root_direction(const ScalpPoint& root, double turn) const {
    const Vec3d along = normalized(
        across(comb_.direction(root.position, root.position, root.normal, 1), root.normal));
    const Vec3d turned = along * cosine(turn) + cross(root.normal, along) * sine(turn);
    const double rise = double{style_.root_angle} * kPi / 180;
    return turned * cosine(rise) + root.normal * sine(rise);
}

// Half of a wisp's depth may sink into the one below it; higher hair lies over lower hair. Near its
// root a wisp is lower.
double Grower::stand_off(const ScalpPoint& root, double way, double length) const {
    const double height = std::clamp(extent_.height(root.position.y), 0.0, 1.0);
    const double layer = style_.volume * height * smooth_step(way / 0.1);
    const double depth = style_.thickness * wisp_radius(style_, way / length);
    return std::min(kSkin + 0.6 * depth + layer, kRootHeight + 0.6 * way);
}

std::vector<Vec3d> Grower::walk(const ScalpPoint& root, double length, double turn) const {
    std::vector<Vec3d> line = {root.position + root.normal * kRootHeight};
    Vec3d direction = root_direction(root, turn);
    const auto strides = static_cast<std::size_t>(std::ceil(length / kStride));
    const double stride = length / static_cast<double>(strides);
    for (std::size_t i = 1; i <= strides; ++i) {
        const Vec3d p = line.back();
        const Solid::Clearance here = body_.clearance(p);
        const double needed = stand_off(root, stride * static_cast<double>(i), length);
        const double lying = smooth_step(1 - (here.distance - needed) / kCombReach);
        const Vec3d wanted = comb_.direction(root.position, p, here.outward, lying);
        direction += (normalized(wanted) - direction) * std::min(1.0, stride / style_.drape);
        // At the surface a wisp does not go deeper; just above it, only as deep as it still may.
        const double room = std::max(0.0, here.distance - needed) / (4 * stride);
        const double sinking = -dot(direction, here.outward);
        if (sinking > room)
            direction += here.outward * (sinking - room);
        direction = normalized(direction);
        const Vec3d next = body_.moved_out(p + direction * stride, needed);
        line.push_back(p + normalized(next - p) * stride);
    }
    return line;
}

// Evens out the corners where a wisp meets the body; the two points at the root keep its direction.
void Grower::smooth(std::vector<Vec3d>& line, const ScalpPoint& root, double length) const {
    const double stride = length / static_cast<double>(line.size() - 1);
    for (int pass = 0; pass < kSmoothings; ++pass) {
        Vec3d before = line[1];
        for (std::size_t i = 2; i + 1 < line.size(); ++i) {
            const Vec3d middle = (before + line[i + 1]) / 2;
            before = line[i];
            line[i] = (line[i] + middle) / 2;
        }
    }
    for (std::size_t i = 2; i < line.size(); ++i)
        line[i] = body_.moved_out(
            line[i],
            std::min(kSkin + 0.004, stand_off(root, stride * static_cast<double>(i), length)));
}

std::vector<Vec3d> Grower::grow(const ScalpPoint& root, double length, double turn) const {
    std::vector<Vec3d> line = walk(root, length, turn);
    smooth(line, root, length);
    return line;
}

} // namespace mane
