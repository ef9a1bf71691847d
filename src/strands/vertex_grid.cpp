#include "strands/vertex_grid.h"

#include "mane/error.h"
#include "strands/catmull_rom.h"

#include <algorithm>

namespace mane {
namespace {

constexpr std::uint32_t kPadding = 16;
constexpr float kNearEnd = 0.25f; // [samples] a vertex nearer to the end is left out

} // namespace

VertexGrid::VertexGrid(std::uint32_t samples_per_segment, std::uint32_t most_pieces)
    : samples_(samples_per_segment) {
    if (samples_ == 0)
        throw InputError("strands need at least 1 sample per segment, found 0");
    for (std::uint32_t v = 0; v < vertices(most_pieces) + kPadding; ++v) {
        const std::uint32_t piece = std::min(v / samples_, most_pieces);
        const float t = static_cast<float>(v % samples_) / static_cast<float>(samples_);
        parameter_.push_back(static_cast<float>(v) / static_cast<float>(samples_));
        piece_.push_back(static_cast<float>(piece));
        const CatmullRomWeights weights(t);
        for (std::size_t j = 0; j < 4; ++j)
            weight_[j].push_back(weights.of[j]);
    }
}

std::uint32_t VertexGrid::before(float end) const {
    const float at = end * static_cast<float>(samples_) - kNearEnd;
    return std::max(static_cast<std::uint32_t>(at) + 1, end > 1 ? samples_ + 1 : samples_);
}

} // namespace mane
