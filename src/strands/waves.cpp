#include "strands/waves.h"

#include "base/functions.h"

#include <algorithm>

namespace mane {

Waves::Waves(const Groom& groom, const Frame& frame, const StrandDesc& desc, std::uint32_t seed)
    : amplitude_(desc.waves > 0 ? std::clamp(desc.wave_amplitude, 0.0f, 1.0f) : 0.0f) {
    if (amplitude_ == 0)
        return;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        add_wisp(groom, frame, w, desc.waves, Random(seed, w));
}

void Waves::add_wisp(const Groom& groom, const Frame& frame, std::size_t wisp, float waves,
                     const Random& random) {
    const double angle = 2 * kPi * random.unit(0);
    const std::size_t first = pieces_.size();
    wisps_.push_back({first, {static_cast<float>(cosine(angle)), static_cast<float>(sine(angle))}});

    const std::uint32_t section = groom.first_section[wisp], count = groom.sections(wisp) - 1;
    const auto designed = [&](std::uint32_t i) {
        return length(groom.position[section + i + 1] - groom.position[section + i]);
    };
    float total = 0; // from x₁ on, where hair is seen
    for (std::uint32_t i = 1; i < count; ++i)
        total += designed(i);
    const float radians = static_cast<float>(2 * kPi) * waves / std::max(total, 1e-6f);

    float phase = static_cast<float>(2 * kPi) * random.unit(1) - radians * designed(0);
    for (std::uint32_t i = 0; i < count; ++i) {
        const float now = length(frame.position[section + i + 1] - frame.position[section + i]);
        const float left = now > designed(i) ? designed(i) / now : 1.0f;
        pieces_.push_back({phase, radians * designed(i), left, left, left});
        phase += radians * designed(i);
    }
    for (std::size_t i = first + 1; i < pieces_.size(); ++i)
        pieces_[i].begin = pieces_[i - 1].end = 0.5f * (pieces_[i - 1].middle + pieces_[i].middle);
}

DiscPoint Waves::at(std::size_t wisp, std::uint32_t piece, float t, float offset) const {
    const Wisp& w = wisps_[wisp];
    const Piece& p = pieces_[w.first_piece + piece];
    const float left = t < 0.5f ? p.begin + (p.middle - p.begin) * 2 * t
                                : p.middle + (p.end - p.middle) * (2 * t - 1);
    const float height =
        amplitude_ * left * static_cast<float>(sine(p.phase + p.phase_change * t + offset));
    return {w.direction.x * height, w.direction.y * height};
}

} // namespace mane
