#include "picture/lighting.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr float kCell =
    0.004f; // [m] of the lights' grids: finer than a wisp, coarser than a strand's gap
constexpr float kSkyCell = 0.01f;   // [m] of the sky's, which is smooth
constexpr float kRayOffset = 1e-3f; // [m] off the surface that a shadow ray leaves
constexpr float kSkinDepth = 3;     // across the surface of the body, for the sky
const Vec3 kNowhere{};
const Vec3 kSky{0.80f, 0.86f, 0.95f};

// To the faces and corners of a cube; brighter above.
std::vector<SkyDirection> sky_directions() {
    std::vector<SkyDirection> sky;
    float sum = 0;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                const int nonzero = (x != 0) + (y != 0) + (z != 0);
                if (nonzero == 0 || nonzero == 2)
                    continue;
                const Vec3 d = normalized(
                    Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)));
                sky.push_back({d, 0.6f + 0.4f * d.y});
                sum += sky.back().weight;
            }
    for (SkyDirection& s : sky)
        s.weight /= sum;
    return sky;
}

} // namespace

Lighting::Lighting(const Lens& lens, const Curves& strands, float width_scale,
                   std::span<const PictureBody> bodies, const RayScene& body_rays)
    : body_rays_(body_rays) {
    const Vec3 up{0, 1, 0}, right = lens.right(), back = -lens.forward();
    lights_[0] = {normalized(back * 0.8f - right * 0.7f + up * 0.9f), Vec3{1, 0.95f, 0.88f} * 3.0f,
                  0.12f};
    lights_[1] = {normalized(back * 0.7f + right * 0.9f + up * 0.2f), Vec3{0.85f, 0.92f, 1} * 0.9f,
                  0.25f};
    lights_[2] = {normalized(back * -0.9f + right * 0.5f + up * 0.8f), Vec3{1, 0.98f, 0.95f} * 1.5f,
                  0.12f};

    Box box;
    box.enclose(strands.position);
    if (strands.position.empty())
        box.enclose({&kNowhere, 1});
    Volume fine(box, kCell);
    add_strands(strands, width_scale, fine);
    for (const Light& light : lights_)
        depth_.push_back(swept_depth(fine, light.direction));

    if (!bodies.empty())
        box.enclose(bodies[0].vertices);
    Volume coarse(box, kSkyCell);
    add_strands(strands, width_scale, coarse);
    if (!bodies.empty())
        add_surface(bodies[0].vertices, bodies[0].triangles, kSkinDepth, coarse);
    open_sky_ = visible_sky(coarse, sky_directions());
}

Vec3 Lighting::reaching(std::size_t i, const Vec3& p, const Vec3& tint, SquarePoint at) const {
    const Light& light = lights_[i];
    const Vec3 side = normalized(cross(light.direction, Vec3{0.31f, 0.27f, 0.91f})),
               other = cross(light.direction, side);
    const float radius = light.spread * std::sqrt(at.x), angle = 6.2831853f * at.y;
    const Vec3 toward = normalized(light.direction + side * (radius * std::cos(angle)) +
                                   other * (radius * std::sin(angle)));
    if (body_rays_.blocked(p + toward * kRayOffset, toward))
        return {};
    // Most of what a strand scatters goes on forward, and takes the strand's colour on.
    const float depth = depth_[i].at(p + light.direction * kCell);
    const auto left = [depth](float c) { return std::exp(-depth * (1.0f - 0.5f * c)); };
    return {left(tint.x), left(tint.y), left(tint.z)};
}

Vec3 Lighting::sky(const Vec3& p) const {
    return kSky * open_sky_->at(p);
}

} // namespace mane
