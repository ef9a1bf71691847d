#include "step/air.h"

#include "base/functions.h"
#include "base/random.h"

#include <cmath>

namespace mane {
namespace {

constexpr int kOctaves = 4;
constexpr int kWavesPerOctave = 6;
constexpr std::uint64_t kAirStream = 0x616972; // keeps these numbers apart from those of wisps

Vec3d random_direction(const Random& random, std::uint64_t n) {
    const double z = 2.0 * random.unit(n) - 1.0, angle = 2 * kPi * random.unit(n + 1),
                 r = std::sqrt(1 - z * z);
    return {r * cosine(angle), r * sine(angle), z};
}

} // namespace

Air::Air(const AirDesc& desc) : mean_(desc.wind) {
    if (!(desc.gusts > 0))
        return;
    const Random random(desc.gust_seed, kAirStream);
    double energy = 0;
    std::uint64_t n = 0;
    for (int octave = 0; octave < kOctaves; ++octave) {
        const double size = desc.gust_size * power(0.5, octave), number = 2 * kPi / size;
        const double amplitude = power(0.5, octave / 3.0); // u ~ size^⅓ (Kolmogorov)
        const double turnover = desc.gusts * amplitude * number;
        for (int i = 0; i < kWavesPerOctave; ++i, n += 8) {
            const Vec3d k = random_direction(random, n);
            const Vec3d across = normalized(cross(k, random_direction(random, n + 2)));
            // Carried along by the mean wind, and changing by itself.
            const double own = turnover * (2.0 * random.unit(n + 4) - 1.0);
            waves_.push_back({k * number, own - number * dot(k, Vec3d(desc.wind)),
                              2 * kPi * random.unit(n + 5), across * amplitude});
            energy += amplitude * amplitude / 2;
        }
    }
    // Three axes share the energy alike on average over directions; each axis is to have the
    // variance gusts².
    const double scale = desc.gusts * std::sqrt(3.0 / energy);
    for (Wave& w : waves_)
        w.amplitude *= scale;
}

Vec3 Air::velocity(const Vec3d& position, double time) const {
    Vec3d v(mean_);
    for (const Wave& w : waves_)
        v += w.amplitude * cosine(dot(w.number, position) + w.rate * time + w.phase);
    return Vec3(v);
}

} // namespace mane
