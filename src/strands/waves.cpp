#include "strands/waves.h"

#include "base/functions.h"
#include "base/random.h"

#include <algorithm>

namespace mane {

Waves::Waves(const DesignedLength& designed, const StrandDesc& desc, std::uint32_t seed)
    : amplitude_(desc.waves > 0 ? std::clamp(desc.wave_amplitude, 0.0f, 1.0f) : 0.0f) {
    if (amplitude_ == 0)
        return;
    std::size_t pieces = 0;
    for (std::size_t w = 0; w < designed.wisp_count(); ++w) {
        const Random random(seed, w);
        const double angle = 2 * kPi * random.unit(0);
        wisps_.push_back({pieces,
                          {static_cast<float>(cosine(angle)), static_cast<float>(sine(angle))},
                          2 * kPi * random.unit(1),
                          2 * kPi * desc.waves / std::max(designed.whole(w), 1e-6f)});
        pieces += designed.pieces(w);
    }
    left_.resize(pieces);
}

void Waves::pose(const DesignedLength& designed, const Frame& frame) {
    std::size_t section = 0;
    for (std::size_t w = 0; w < wisps_.size(); ++w) {
        Left* left = left_.data() + wisps_[w].first_piece;
        const std::uint32_t pieces = designed.pieces(w);
        for (std::uint32_t i = 0; i < pieces; ++i) {
            const float now = length(frame.position[section + i + 1] - frame.position[section + i]);
            const float share = std::min(1.0f, designed.segment(w, i) / now);
            left[i].begin = left[i].middle = left[i].end = amplitude_ * share;
        }
        for (std::uint32_t i = 1; i < pieces; ++i)
            left[i].begin = left[i - 1].end = 0.5f * (left[i - 1].middle + left[i].middle);
        section += pieces + 1;
    }
}

} // namespace mane
