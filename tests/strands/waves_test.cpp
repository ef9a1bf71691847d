#include "mane/strands.h"

#include "random_hair.h"

#include <array>
#include <cmath>
#include <doctest/doctest.h>

using namespace mane;
using namespace mane::test;

namespace {

constexpr std::uint32_t kSections = 6, kSamples = 40;
constexpr float kRadius = 0.01f, kAmplitude = 0.3f, kWaves = 3;

// The first strand of a straight wisp whose segment i is `stretch[i]` times its designed length.
std::vector<Vec3> wavy_strand(std::array<float, kSections - 1> stretch) {
    Hair hair = straight_hair(kSections, 0.04f, kRadius);
    for (std::uint32_t i = 1; i < kSections; ++i)
        hair.frame.position[i] = hair.frame.position[i - 1] + Vec3{0, -0.04f * stretch[i - 1], 0};
    StrandDesc desc;
    desc.count = 1;
    desc.jitter = desc.length_jitter = 0;
    desc.waves = kWaves;
    desc.wave_amplitude = kAmplitude;
    return make_strands(hair.groom, hair.frame, desc, 5, kSamples).position;
}

Vec3 across(const Vec3& p) {
    return {p.x, 0, p.z};
}

// Where a strand stands when its waves are taken away: with the waves scaled by f, offset = place +
// f·wave.
Vec3 place_of(const Vec3& rest, const Vec3& stretched, float f) {
    return (across(stretched) - across(rest) * f) / (1 - f);
}

} // namespace

TEST_CASE("waves: a stretched wisp keeps their number and has them lower (M18)") {
    const std::vector<Vec3> rest = wavy_strand({1, 1, 1, 1, 1});
    const std::vector<Vec3> stretched = wavy_strand({1.25f, 1.25f, 1.25f, 1.25f, 1.25f});
    const Vec3 place = place_of(rest[0], stretched[0], 0.8f);
    CHECK(length(place) <= kRadius * (1 - kAmplitude) * 1.0001f);

    float largest = 0;
    Vec3 direction;
    for (std::size_t v = 0; v < rest.size(); ++v) {
        CHECK(length(place_of(rest[v], stretched[v], 0.8f) - place) < 1e-7f);
        const Vec3 wave = across(rest[v]) - place;
        if (length(wave) > largest)
            largest = length(wave), direction = wave;
    }
    CHECK(largest == doctest::Approx(kRadius * kAmplitude).epsilon(2e-3)); // sampled: cos(π·3/160)

    int changes = 0; // from x₁ on: two a wave
    for (std::size_t v = kSamples + 1; v < rest.size(); ++v)
        changes += (dot(across(rest[v]) - place, direction) > 0) !=
                   (dot(across(rest[v - 1]) - place, direction) > 0);
    CHECK(changes == doctest::Approx(2 * kWaves).epsilon(1.01 / (2 * kWaves)));
}

TEST_CASE(
    "waves: one stretched segment has its own amplitude in its middle, its far neighbours theirs") {
    const std::vector<Vec3> rest = wavy_strand({1, 1, 1, 1, 1}), all = wavy_strand({2, 2, 2, 2, 2});
    const std::vector<Vec3> one = wavy_strand({1, 1, 2, 1, 1});
    const auto near = [](const Vec3& a, const Vec3& b) {
        return length(across(a) - across(b)) < 1e-8f;
    };
    CHECK(near(one[2 * kSamples + kSamples / 2], all[2 * kSamples + kSamples / 2]));
    CHECK(near(one[kSamples / 2], rest[kSamples / 2]));
    CHECK(near(one[5 * kSamples], rest[5 * kSamples]));
}

TEST_CASE("waves: a compressed wisp keeps their amplitude") {
    const std::vector<Vec3> rest = wavy_strand({1, 1, 1, 1, 1}),
                            pressed = wavy_strand({0.6f, 0.6f, 0.6f, 0.6f, 0.6f});
    for (std::size_t v = 0; v < rest.size(); ++v)
        CHECK(length(across(rest[v]) - across(pressed[v])) < 1e-8f);
}
