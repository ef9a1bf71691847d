#include "picture/hair_shading.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kScatteredOften = 0.6f; // by eye: TT has counted much of this light already
constexpr float kFacing = 0.0465f;      // reflectance of keratin (index 1.55) seen straight on

float fresnel(float cosine) {
    const float c = 1 - std::clamp(cosine, 0.0f, 1.0f), c2 = c * c;
    return kFacing + (1 - kFacing) * c2 * c2 * c;
}

float lobe(float width, float angle) {
    return std::exp(-0.5f * angle * angle / (width * width)) / (std::sqrt(2 * kPi) * width);
}

Vec3 power(const Vec3& colour, float p) {
    const auto channel = [p](float c) { return std::pow(std::max(c, 1e-4f), p); };
    return {channel(colour.x), channel(colour.y), channel(colour.z)};
}

} // namespace

Vec3 scattered_once(const HairMaterial& material, const Vec3& tangent, const Vec3& viewer,
                    const Vec3& light) {
    const float sin_v = std::clamp(dot(tangent, viewer), -1.0f, 1.0f);
    const float sin_l = std::clamp(dot(tangent, light), -1.0f, 1.0f);
    const float cos_d =
        std::max(std::cos(0.5f * std::abs(std::asin(sin_v) - std::asin(sin_l))), 0.1f);
    const Vec3 across_v = viewer - tangent * sin_v, across_l = light - tangent * sin_l;
    const float norm = std::sqrt(dot(across_v, across_v) * dot(across_l, across_l) + 1e-8f);
    const float cos_phi = std::clamp(dot(across_v, across_l) / norm, -1.0f, 1.0f);
    const float cos_half_phi = std::sqrt(0.5f + 0.5f * cos_phi);
    const float bravais =
        1.19f / cos_d + 0.36f * cos_d; // index of refraction as seen in the normal plane
    const float width = material.roughness * material.roughness;
    const float angle = sin_l + sin_v;

    const float r = lobe(width * 1.414f * std::max(cos_half_phi, 0.1f),
                         angle + 2 * material.tilt * cos_half_phi) *
                    0.25f * cos_half_phi *
                    fresnel(std::sqrt(std::clamp(0.5f + 0.5f * dot(viewer, light), 0.0f, 1.0f)));

    const float a = 1 / bravais;
    const float h = cos_half_phi * (1 + a * (0.6f - 0.8f * cos_phi));
    const float entering = 1 - fresnel(cos_d * std::sqrt(std::clamp(1 - h * h, 0.0f, 1.0f)));
    const float path = std::sqrt(std::max(1 - h * h * a * a, 0.0f)) / cos_d;
    const Vec3 tt = power(material.colour, 0.5f * path) *
                    (lobe(width * 0.5f, angle - material.tilt) * entering * entering *
                     std::exp(-3.65f * cos_phi - 3.98f));

    const float inner = fresnel(cos_d * 0.5f);
    const Vec3 trt = power(material.colour, 0.8f / cos_d) *
                     (lobe(width * 2, angle - 4 * material.tilt) * (1 - inner) * (1 - inner) *
                      inner * std::exp(17 * cos_phi - 16.78f));

    return Vec3{r, r, r} + tt + trt;
}

Vec3 scattered_often(const HairMaterial& material, const Vec3& tangent, const Vec3& viewer,
                     const Vec3& light, const Vec3& lit) {
    const Vec3 facing = normalized(viewer - tangent * dot(viewer, tangent));
    const float wrapped = std::max(0.0f, (dot(facing, light) + 1) / 4) / kPi;
    const float luminance = std::max(dot(material.colour, Vec3{0.2126f, 0.7152f, 0.0722f}), 1e-3f);
    const Vec3 hue =
        power(material.colour / luminance, 1 - std::clamp((lit.x + lit.y + lit.z) / 3, 0.0f, 1.0f));
    const Vec3 bright = power(material.colour, 0.75f);
    return Vec3{bright.x * hue.x, bright.y * hue.y, bright.z * hue.z} * (kScatteredOften * wrapped);
}

} // namespace mane
