#include "base/parallel_for.h"
#include "base/random.h"
#include "mane/error.h"
#include "mane/picture.h"
#include "mane/strands.h"
#include "picture/camera.h"
#include "picture/hair_shading.h"
#include "picture/lighting.h"
#include "picture/pixel_sample.h"
#include "picture/ray_scene.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

// What a sample chooses: its point in the pixel, then one of each light.
enum Choice : std::uint32_t { kPixelChoice, kLightChoice };

const Vec3 kClay{0.52f, 0.37f, 0.30f}, kObstacle{0.42f, 0.45f, 0.48f};

Vec3 times(const Vec3& a, const Vec3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

// Neighbouring numbers get hues far apart: steps of the golden ratio round the circle.
Vec3 wisp_colour(std::uint32_t wisp) {
    const float hue = 6 * (static_cast<float>(wisp) * 0.61803399f -
                           std::floor(static_cast<float>(wisp) * 0.61803399f));
    const auto channel = [hue](float at) {
        float d = std::abs(hue - at);
        d = std::min(d, 6 - d);
        return 0.12f + 0.7f * std::clamp(2 - d, 0.0f, 1.0f);
    };
    return {channel(0), channel(2), channel(4)};
}

// The frame as shapes for rays, and what each shape is made of.
class Scene {
  public:
    Scene(const Groom& groom, const Frame& frame, const StrandDesc& strands, std::uint32_t seed,
          std::span<const PictureBody> bodies, const HeadPose& head, const PictureDesc& desc)
        : desc_(desc),
          lens_(desc.camera ? *desc.camera : camera_for(desc.view, head, desc.frame_height),
                frame.origin, desc.width, desc.height) {
        for (const PictureBody& body : bodies) {
            body_rays_.add_mesh(body.vertices, body.triangles);
            all_.add_mesh(body.vertices, body.triangles);
        }
        body_rays_.commit();
        body_count_ = static_cast<std::uint32_t>(bodies.size());

        Curves shading;
        float width_scale = 1;
        switch (desc.layer) {
        case PictureLayer::strands: {
            StrandDesc drawn = strands;
            drawn.count = std::min(desc.strands, strands.count);
            StrandShape shape(groom, drawn, seed, kSamples, {.threads = desc.threads});
            shape.pose(frame);
            for (std::size_t s = 0; s < shape.strand_count(); ++s)
                wisp_of_.push_back(shape.wisp(s));
            shading = shape.curves();
            width_scale =
                static_cast<float>(strands.count) / static_cast<float>(std::max(drawn.count, 1u));
            if (!shading.position.empty())
                all_.add_ribbons(shading, width_scale);
            break;
        }
        case PictureLayer::skeleton: {
            Curves skeleton = skeleton_curves(groom, frame, kSamples);
            std::fill(skeleton.width.begin(), skeleton.width.end(), kSkeletonWidth);
            for (std::uint32_t w = 0; w < groom.wisp_count(); ++w)
                wisp_of_.push_back(w);
            if (!skeleton.position.empty())
                all_.add_ribbons(skeleton, 1);
            break;
        }
        case PictureLayer::envelope: {
            const Mesh mesh = envelope_mesh(groom, frame);
            for (std::uint32_t w = 0; w < groom.wisp_count(); ++w)
                wisp_of_.insert(wisp_of_.end(), envelope_triangles(groom.sections(w)), w);
            if (!mesh.triangles.empty())
                all_.add_mesh(mesh.vertices, mesh.triangles);
            break;
        }
        case PictureLayer::character:
            break;
        }
        all_.commit();
        lighting_.emplace(lens_, shading, width_scale, bodies, body_rays_);
    }

    /// Light from the picture's point (x, y) [pixels].
    Vec3 radiance(float x, float y, const PixelSample& sample) const {
        const Vec3 direction = lens_.direction(x, y);
        const RayHit hit = all_.first_hit(lens_.eye(), direction);
        if (!hit)
            return background(y);
        const bool hair = hit.shape >= body_count_;
        if (hair && desc_.layer != PictureLayer::envelope)
            return strand(hit, -direction, sample);
        const Vec3 colour = hair             ? wisp_colour(wisp_of_[hit.part])
                            : hit.shape == 0 ? kClay
                                             : kObstacle;
        return surface(hit, -direction, colour, sample);
    }

  private:
    static constexpr std::uint32_t kSamples = 4; // per segment: a vertex every centimetre or so
    static constexpr float kSkeletonWidth = 0.0025f;

    static std::size_t envelope_triangles(std::uint32_t sections) {
        return 2 * 16 * (4 * (sections - 1) + 1);
    }

    Vec3 background(float y) const {
        const float t = y / static_cast<float>(desc_.height);
        return Vec3{0.60f, 0.64f, 0.68f} * (1 - t) + Vec3{0.36f, 0.38f, 0.41f} * t;
    }

    Vec3 strand(const RayHit& hit, const Vec3& viewer, const PixelSample& sample) const {
        const bool by_wisp = desc_.colour_by_wisp || desc_.layer == PictureLayer::skeleton;
        const HairMaterial material{by_wisp ? wisp_colour(wisp_of_[hit.part]) : varied(hit.part)};
        const Vec3 sky = lighting_->sky(hit.point);
        Vec3 sum = times(sky, material.colour) * 0.55f;
        for (std::uint32_t i = 0; i < Lighting::kLights; ++i) {
            const Vec3 lit =
                lighting_->reaching(i, hit.point, material.colour, sample.point(kLightChoice + i));
            if (lit == Vec3{})
                continue;
            const Light& light = lighting_->light(i);
            const Vec3 seen =
                scattered_once(material, hit.direction, viewer, light.direction) +
                scattered_often(material, hit.direction, viewer, light.direction, lit);
            sum += times(times(light.radiance, lit), seen);
        }
        return sum;
    }

    // No two hairs of a head have quite the same colour.
    Vec3 varied(std::uint32_t strand) const {
        const float much = Random(1, strand).between(0, 0.75f, 1.3f);
        const auto channel = [much](float c) { return std::clamp(c * much, 0.0f, 0.99f); };
        return {channel(desc_.hair_colour.x), channel(desc_.hair_colour.y),
                channel(desc_.hair_colour.z)};
    }

    Vec3 surface(const RayHit& hit, const Vec3& viewer, const Vec3& colour,
                 const PixelSample& sample) const {
        const Vec3 normal = dot(hit.direction, viewer) < 0 ? -hit.direction : hit.direction;
        Vec3 sum =
            times(lighting_->sky(hit.point + normal * 0.015f), colour) * (0.75f + 0.25f * normal.y);
        for (std::uint32_t i = 0; i < Lighting::kLights; ++i) {
            const Light& light = lighting_->light(i);
            // Light goes a little round the terminator, as it does under skin.
            const float wrapped = (dot(normal, light.direction) + 0.15f) / 1.15f;
            if (wrapped <= 0)
                continue;
            const Vec3 lit =
                lighting_->reaching(i, hit.point + normal * 0.002f, {0.3f, 0.2f, 0.15f},
                                    sample.point(kLightChoice + i));
            const Vec3 half = normalized(viewer + light.direction);
            const float gloss = 0.04f * std::pow(std::max(dot(normal, half), 0.0f), 24.0f);
            sum += times(times(light.radiance, lit),
                         colour * (wrapped / 3.14159265f) + Vec3{gloss, gloss, gloss});
        }
        return sum;
    }

    const PictureDesc& desc_;
    Lens lens_;
    RayScene all_, body_rays_;
    std::uint32_t body_count_ = 0;
    std::vector<std::uint32_t> wisp_of_; // per strand, skeleton or envelope triangle
    std::optional<Lighting> lighting_;
};

// One channel of a pixel; `dither` in [0, 1) instead of rounding, or smooth shades would show
// steps.
std::uint8_t encoded(float x, float dither) {
    const float soft =
        x < 0.6f ? x : 0.6f + 0.4f * (1 - std::exp(-(x - 0.6f) / 0.4f)); // highlights roll off
    const float srgb =
        soft <= 0.0031308f ? 12.92f * soft : 1.055f * std::pow(soft, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::clamp(srgb, 0.0f, 1.0f) * 254.999f + dither);
}

Vec3 pixel(const Scene& scene, std::uint32_t x, std::uint32_t y, std::uint32_t samples) {
    Vec3 sum;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const PixelSample sample(x, y, i);
        const SquarePoint at = sample.point(kPixelChoice);
        sum += scene.radiance(static_cast<float>(x) + at.x, static_cast<float>(y) + at.y, sample);
    }
    return sum / static_cast<float>(samples);
}

} // namespace

Image render(const Groom& groom, const Frame& frame, const StrandDesc& strands, std::uint32_t seed,
             std::span<const PictureBody> bodies, const HeadPose& head, const PictureDesc& desc) {
    if (desc.width == 0 || desc.height == 0 || desc.samples == 0)
        throw InputError("a picture needs at least 1 pixel and 1 sample, found " +
                         std::to_string(desc.width) + " × " + std::to_string(desc.height) +
                         " pixels, " + std::to_string(desc.samples) + " samples");
    const Scene scene(groom, frame, strands, seed, bodies, head, desc);
    Image image{desc.width, desc.height, {}};
    image.pixels.resize(std::size_t{desc.width} * desc.height);
    Threads(desc.threads).run(desc.height, [&](std::size_t y) {
        for (std::uint32_t x = 0; x < desc.width; ++x) {
            const Vec3 light = pixel(scene, x, static_cast<std::uint32_t>(y), desc.samples);
            const Random dither(x, y, desc.samples);
            image.pixels[y * desc.width + x] = {encoded(light.x, dither.unit(0)),
                                                encoded(light.y, dither.unit(1)),
                                                encoded(light.z, dither.unit(2))};
        }
    });
    return image;
}

} // namespace mane
