#include "groom/comb.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

double smooth(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

constexpr double kPartingEnd =
    0.35; // front(z) behind which hair is not parted but falls back from the crown

} // namespace

ScalpExtent scalp_extent(const Mesh& mesh, std::span<const std::uint32_t> scalp) {
    ScalpExtent e{Vec3d(mesh.vertices[mesh.triangles[scalp[0]][0]]), {}};
    e.high = e.low;
    for (std::uint32_t t : scalp)
        for (std::uint32_t v : mesh.triangles[t]) {
            const Vec3d p(mesh.vertices[v]);
            e.low = {std::min(e.low.x, p.x), std::min(e.low.y, p.y), std::min(e.low.z, p.z)};
            e.high = {std::max(e.high.x, p.x), std::max(e.high.y, p.y), std::max(e.high.z, p.z)};
        }
    return e;
}

// −1 to the right of the parting, 1 to its left; hair near it goes to its side all the same.
double Comb::side(const Vec3d& root) const {
    const double off = root.x - style_.parting;
    return off < 0 ? -smooth(-0.005, 0.01, -off) : smooth(-0.005, 0.01, off);
}

Vec3d Comb::direction(const Vec3d& root, const Vec3d& p, const Vec3d& outward, double lying) const {
    const double parted = smooth(0.15, kPartingEnd + 0.1, extent_.front(root.z));
    const double over_nape = smooth(0.0, 0.2, extent_.height(p.y));
    const double on_top = lying * over_nape * smooth(-0.2, 0.6, outward.y);
    Vec3d d{0, -1, 0};
    // On top of the head: from the parting to the sides, and from the crown down the back.
    d.x += style_.comb_side * side(root) * parted * on_top;
    d.z -= (1 - parted) * on_top;
    // Back from the face.
    const double before_ears = smooth(0.45, 0.8, extent_.front(p.z));
    d.z -= style_.comb_back * before_ears * lying * over_nape;
    d += over_shoulder(root, p, outward, lying);
    return d;
}

// Hair that comes down on a shoulder goes in front of it or behind, by where it is rooted, and not
// off along the arm: it leans that way from the nape on, until the body no longer is below it.
Vec3d Comb::over_shoulder(const Vec3d& root, const Vec3d& p, const Vec3d& outward,
                          double lying) const {
    const double way = extent_.front(root.z) > style_.front ? 1 : -1;
    const double below_nape = 1 - smooth(-0.3, 0.05, extent_.height(p.y));
    const double past = smooth(0.2, 0.7, way * outward.z);
    const double resting = lying * smooth(0.3, 0.9, outward.y);
    return {-below_nape * resting * outward.x, 0, way * below_nape * (1 - past) * (0.5 + resting)};
}

bool Comb::on_parting(const ScalpPoint& p) const {
    return std::fabs(p.position.x - style_.parting) < style_.parting_width / 2 &&
           extent_.front(p.position.z) > kPartingEnd && p.normal.y > 0.3;
}

} // namespace mane
