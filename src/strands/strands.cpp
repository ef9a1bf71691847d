#include "mane/strands.h"

#include "base/parallel_for.h"
#include "strands/drawn_envelope.h"
#include "strands/recipe.h"
#include "strands/strand_layout.h"
#include "strands/waves.h"

#include <algorithm>

namespace mane {

struct StrandShape::Data {
    Data(const Groom& groom, const Frame& frame, const StrandDesc& d, std::uint32_t seed,
         std::uint32_t samples)
        : desc(d), layout(groom, d.count, samples), envelope(groom, frame),
          waves(groom, frame, d, seed), recipes(groom, d, seed, waves.amplitude()) {}

    // Vertex x₁ is at p = 1 in every strand, so that one number tells which vertices show (M33);
    // behind it the samples share what the strand has.
    float parameter(std::uint32_t vertices, std::uint32_t vertex, float end) const {
        const std::uint32_t outside = layout.samples();
        if (vertex <= outside)
            return static_cast<float>(vertex) / static_cast<float>(outside);
        if (vertex + 1 == vertices)
            return end;
        return 1 + (end - 1) * static_cast<float>(vertex - outside) /
                       static_cast<float>(vertices - 1 - outside);
    }

    // The control points are those of §5.2, the disc's point moved toward the skeleton by jitter
    // and linked by Catmull-Rom. What is interpolated is the share that jitter leaves, in the
    // interpolated section, and not the moved points: the same curve where neighbouring half lines
    // are equal, but the overshoot stays jitter/8 of the local radius beside a section that is
    // pressed flat, where interpolated points would leave the envelope (M17).
    Vec3 point(std::size_t wisp, const StrandRecipe& recipe, float p) const {
        const std::uint32_t piece =
            std::min(static_cast<std::uint32_t>(p), envelope.pieces(wisp) - 1);
        const float t = p - static_cast<float>(piece);
        const float share = recipe.share[piece].at(t);
        DiscPoint disc{recipe.place.x * share, recipe.place.y * share};
        if (waves.amplitude() > 0) {
            const DiscPoint wave = waves.at(wisp, piece, t, recipe.phase);
            disc = {disc.x + wave.x, disc.y + wave.y};
        }
        return envelope.at(wisp, piece, t, disc);
    }

    void draw(std::size_t wisp, const StrandRecipe& recipe, std::span<Vec3> positions,
              std::span<float> widths) const {
        const std::uint32_t vertices = layout.wisp(wisp).vertices;
        const float thinner = (desc.tip_width - desc.root_width) / static_cast<float>(vertices - 1);
        for (std::uint32_t i = 0; i < vertices; ++i) {
            positions[i] = point(wisp, recipe, parameter(vertices, i, recipe.end));
            widths[i] = desc.root_width + thinner * static_cast<float>(i);
        }
    }

    StrandDesc desc;
    StrandLayout layout;
    DrawnEnvelope envelope;
    Waves waves;
    StrandRecipes recipes;
};

StrandShape::StrandShape(const Groom& groom, const Frame& frame, const StrandDesc& desc,
                         std::uint32_t seed, std::uint32_t samples_per_segment)
    : data_(std::make_unique<Data>(groom, frame, desc, seed, samples_per_segment)) {}
StrandShape::~StrandShape() = default;
StrandShape::StrandShape(StrandShape&&) noexcept = default;
StrandShape& StrandShape::operator=(StrandShape&&) noexcept = default;

std::size_t StrandShape::strand_count() const {
    return data_->layout.strand_count();
}
std::size_t StrandShape::vertex_count() const {
    return data_->layout.vertex_count();
}
std::size_t StrandShape::first_vertex(std::size_t strand) const {
    return data_->layout.first_vertex(strand);
}
std::uint32_t StrandShape::wisp(std::size_t strand) const {
    return static_cast<std::uint32_t>(data_->layout.wisp_of(strand));
}
std::uint32_t StrandShape::outside_vertex() const {
    return data_->layout.samples();
}

float StrandShape::parameter(std::size_t strand, std::uint32_t vertex) const {
    const std::size_t w = data_->layout.wisp_of(strand);
    StrandRecipe recipe;
    data_->recipes.make(w, strand - data_->layout.wisp(w).first_strand, recipe);
    return data_->parameter(data_->layout.wisp(w).vertices, vertex, recipe.end);
}

void StrandShape::fill(std::size_t first, std::size_t count, std::span<Vec3> positions,
                       std::span<float> widths) const {
    if (count == 0)
        return;
    StrandRecipe recipe;
    std::size_t w = data_->layout.wisp_of(first), vertex = 0;
    for (std::size_t s = first; s < first + count; ++s) {
        while (s >= data_->layout.wisp(w + 1).first_strand)
            ++w;
        const StrandLayout::Wisp& wisp = data_->layout.wisp(w);
        data_->recipes.make(w, s - wisp.first_strand, recipe);
        data_->draw(w, recipe, positions.subspan(vertex, wisp.vertices),
                    widths.subspan(vertex, wisp.vertices));
        vertex += wisp.vertices;
    }
}

Curves make_strands(const Groom& groom, const Frame& frame, const StrandDesc& desc,
                    std::uint32_t seed, std::uint32_t samples_per_segment, unsigned threads) {
    const StrandShape shape(groom, frame, desc, seed, samples_per_segment);
    const std::size_t strands = shape.strand_count();
    Curves curves;
    curves.first_vertex.resize(strands + 1);
    for (std::size_t s = 0; s <= strands; ++s)
        curves.first_vertex[s] = static_cast<std::uint32_t>(shape.first_vertex(s));
    curves.position.resize(shape.vertex_count());
    curves.width.resize(shape.vertex_count());

    constexpr std::size_t kChunk = 512; // strands: about 100 µs
    Threads(threads).run((strands + kChunk - 1) / kChunk, [&](std::size_t c) {
        const std::size_t first = c * kChunk, count = std::min(kChunk, strands - first);
        const std::size_t begin = curves.first_vertex[first],
                          size = curves.first_vertex[first + count] - begin;
        shape.fill(first, count, std::span(curves.position).subspan(begin, size),
                   std::span(curves.width).subspan(begin, size));
    });
    return curves;
}

} // namespace mane
