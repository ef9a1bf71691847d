#include "base/functions.h"
#include "character/bust_shape.h"
#include "mane/character.h"

#include <algorithm>

namespace mane {
namespace {

// The hairline's height [m] by the angle around the head, from the face (0) to the nape (180°).
struct HairlinePoint {
    double angle, height;
};
constexpr HairlinePoint kHairline[] = {
    {0, 1.604},  {28, 1.604}, {42, 1.602},  {56, 1.588},  {66, 1.564},  {76, 1.548},
    {84, 1.556}, {94, 1.563}, {108, 1.554}, {120, 1.516}, {140, 1.486}, {180, 1.478},
};

double hairline_height(double angle) {
    const auto after = std::find_if(std::begin(kHairline) + 1, std::end(kHairline) - 1,
                                    [&](const HairlinePoint& h) { return h.angle >= angle; });
    const HairlinePoint &a = after[-1], &b = *after;
    return a.height + (b.height - a.height) * (angle - a.angle) / (b.angle - a.angle);
}

bool has_hair(const Vec3d& p) {
    const double middle = -0.012; // [m] the axis around which the angle is measured
    const double angle = arc_tangent(std::fabs(p.x), p.z - middle) * 180 / kPi;
    return p.y > hairline_height(angle) && ear_distance(p) > 0.004;
}

} // namespace

std::vector<std::uint32_t> bust_scalp(const Body& bust) {
    std::vector<std::uint32_t> scalp;
    for (std::uint32_t t = 0; t < bust.mesh.triangles.size(); ++t) {
        const auto& corners = bust.mesh.triangles[t];
        if (std::all_of(corners.begin(), corners.end(),
                        [&](std::uint32_t v) { return has_hair(Vec3d(bust.mesh.vertices[v])); }))
            scalp.push_back(t);
    }
    return scalp;
}

} // namespace mane
