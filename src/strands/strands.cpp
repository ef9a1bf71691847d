#include "mane/strands.h"

#include "base/functions.h"
#include "mane/error.h"
#include "strands/draw_strands.h"
#include "strands/recipe.h"

#include <algorithm>
#include <optional>
#include <string>

namespace mane {
namespace {

constexpr std::size_t kStrandsPerChunk = 512; // some 40 µs

/// Segments of the longest wisp.
std::uint32_t most_pieces(const DesignedLength& designed) {
    std::uint32_t most = 1;
    for (std::size_t w = 0; w < designed.wisp_count(); ++w)
        most = std::max(most, designed.pieces(w));
    return most;
}

/// What turns or waves strands along their wisp, at the vertices of every wisp's grid: sines and
/// cosines, which no frame changes.
class GridAngles {
  public:
    template <typename Angle>
    GridAngles(const DesignedLength& designed, const VertexGrid& grid, Angle&& angle) {
        for (std::size_t w = 0; w < designed.wisp_count(); ++w) {
            first_.push_back(cosine_.size());
            const std::uint32_t vertices = grid.vertices(designed.pieces(w));
            for (std::uint32_t v = 0; v < vertices; ++v) {
                const AlongWisp at = designed.along(w, grid.parameter()[v]);
                const double a = angle(w, double{designed.to(w, at)});
                cosine_.push_back(static_cast<float>(mane::cosine(a)));
                sine_.push_back(static_cast<float>(mane::sine(a)));
            }
        }
        cosine_.resize(cosine_.size() + StrandRecipes::kPadding);
        sine_.resize(cosine_.size());
    }
    const float* cosine(std::size_t wisp) const { return cosine_.data() + first_[wisp]; }
    const float* sine(std::size_t wisp) const { return sine_.data() + first_[wisp]; }

  private:
    std::vector<std::size_t> first_;
    std::vector<float> cosine_, sine_;
};

/// What is worked out for one wisp, kept from wisp to wisp.
struct Scratch {
    GridRows rows;
    AlignedVector<float> wave_sine, wave_cosine; // per vertex of the grid
    AlignedVector<float> end_amplitude;          // per strand of the wisp
};

} // namespace

struct StrandShape::Data {
    Data(const Groom& groom, const StrandDesc& d, std::uint32_t seed, std::uint32_t samples,
         const StrandOptions& options)
        : threads(options.threads), desc(d), layout(groom, d.count), designed(groom),
          grid(samples, most_pieces(designed)), envelope(groom), waves(designed, d, seed),
          recipes(d, seed, layout, designed, envelope, waves, grid, threads),
          kernels(strand_kernels(options.instruction_set)) {
        if (waves.amplitude() > 0)
            wave_angles.emplace(designed, grid, [&](std::size_t w, double length) {
                return waves.phase(w, length);
            });
        if (desc.curls != 0)
            curl_angles.emplace(designed, grid, [&](std::size_t w, double length) {
                return designed.turn(w, double{desc.curls}, length);
            });
    }

    void pose(const Frame& frame) {
        envelope.pose(frame, threads);
        waves.pose(designed, frame);
        posed = true;
    }

    /// Throws InputError unless there are these strands, and room for their vertices.
    void expect(std::size_t first, std::size_t count, std::size_t positions,
                std::size_t widths) const {
        if (!posed)
            throw InputError("strands are drawn before their first frame; pose them first");
        const std::size_t strands = layout.strand_count();
        if (first > strands || count > strands - first)
            throw InputError("strands from " + std::to_string(first) + " on, found " +
                             std::to_string(count) + " of them, expected at most " +
                             std::to_string(strands - std::min(first, strands)));
        const std::size_t vertices = recipes.vertex[first + count] - recipes.vertex[first];
        for (const auto& [what, found] : {std::pair("positions", positions), {"widths", widths}})
            if (found != vertices)
                throw InputError("strands: found room for " + std::to_string(found) + " " + what +
                                 ", expected " + std::to_string(vertices));
    }

    void fill(std::size_t first, std::size_t last, Vec3* positions, float* widths) const {
        Scratch scratch;
        const std::size_t vertex = recipes.vertex[first];
        for (std::size_t w = layout.wisp_of(first); first < last; ++w) {
            const std::size_t behind = std::min(last, layout.first_strand(w + 1));
            if (first == behind)
                continue;
            const WispToDraw wisp = to_draw(w, first, behind, scratch);
            kernels.lay_grid(wisp, scratch.rows);
            const std::size_t begin = recipes.vertex[first] - vertex;
            kernels.draw(wisp, scratch.rows, first, behind - first, positions + begin,
                         widths + begin);
            first = behind;
        }
    }

    WispToDraw to_draw(std::size_t w, std::size_t first, std::size_t behind,
                       Scratch& scratch) const {
        WispToDraw wisp{.envelope = envelope,
                        .recipes = recipes,
                        .grid = grid,
                        .wisp = w,
                        .first_strand = layout.first_strand(w),
                        .root_width = desc.root_width,
                        .tip_width = desc.tip_width};
        if (wave_angles) {
            measure_waves(w, first, behind, scratch);
            wisp.wave_direction = waves.direction(w);
            wisp.wave_sine = scratch.wave_sine.data();
            wisp.wave_cosine = scratch.wave_cosine.data();
            wisp.end_amplitude = scratch.end_amplitude.data();
        }
        if (curl_angles) {
            wisp.curl_cosine = curl_angles->cosine(w);
            wisp.curl_sine = curl_angles->sine(w);
        }
        return wisp;
    }

    /// The waves of wisp `w` now: along its grid, and at the ends of strands `first` … `behind`
    /// − 1.
    void measure_waves(std::size_t w, std::size_t first, std::size_t behind,
                       Scratch& scratch) const {
        const std::uint32_t vertices = grid.vertices(designed.pieces(w));
        const auto amplitude_at = [&](float p) { return waves.amplitude(w, designed.along(w, p)); };
        scratch.wave_sine.resize(vertices + StrandRecipes::kPadding);
        scratch.wave_cosine.resize(vertices + StrandRecipes::kPadding);
        for (std::uint32_t v = 0; v < vertices; ++v) {
            const float amplitude = amplitude_at(grid.parameter()[v]);
            scratch.wave_sine[v] = amplitude * wave_angles->sine(w)[v];
            scratch.wave_cosine[v] = amplitude * wave_angles->cosine(w)[v];
        }
        scratch.end_amplitude.resize(behind - first + StrandRecipes::kPadding);
        for (std::size_t n = first; n < behind; ++n)
            scratch.end_amplitude[n - first] = amplitude_at(recipes.end[n]);
    }

    mutable Threads threads;
    StrandDesc desc;
    StrandLayout layout;
    DesignedLength designed;
    VertexGrid grid;
    DrawnEnvelope envelope;
    Waves waves;
    StrandRecipes recipes;
    StrandKernels kernels;
    std::optional<GridAngles> wave_angles, curl_angles;
    bool posed = false;
};

StrandShape::StrandShape(const Groom& groom, const StrandDesc& desc, std::uint32_t seed,
                         std::uint32_t samples_per_segment, const StrandOptions& options)
    : data_(std::make_unique<Data>(groom, desc, seed, samples_per_segment, options)) {}
StrandShape::~StrandShape() = default;
StrandShape::StrandShape(StrandShape&&) noexcept = default;
StrandShape& StrandShape::operator=(StrandShape&&) noexcept = default;

void StrandShape::pose(const Frame& frame) {
    data_->pose(frame);
}

std::size_t StrandShape::strand_count() const {
    return data_->layout.strand_count();
}
std::size_t StrandShape::vertex_count() const {
    return data_->recipes.vertex[strand_count()];
}
std::size_t StrandShape::first_vertex(std::size_t strand) const {
    return data_->recipes.vertex[strand];
}
std::uint32_t StrandShape::wisp(std::size_t strand) const {
    return static_cast<std::uint32_t>(data_->layout.wisp_of(strand));
}
std::uint32_t StrandShape::outside_vertex() const {
    return data_->grid.samples();
}
float StrandShape::parameter(std::size_t strand, std::uint32_t vertex) const {
    const bool last = first_vertex(strand) + vertex + 1 == first_vertex(strand + 1);
    return last ? data_->recipes.end[strand] : data_->grid.parameter()[vertex];
}

void StrandShape::fill(std::size_t first, std::size_t count, std::span<Vec3> positions,
                       std::span<float> widths) const {
    data_->expect(first, count, positions.size(), widths.size());
    data_->fill(first, first + count, positions.data(), widths.data());
}

void StrandShape::fill(std::span<Vec3> positions, std::span<float> widths) const {
    data_->expect(0, strand_count(), positions.size(), widths.size());
    const auto some = [&](std::size_t first, std::size_t last) {
        const std::size_t begin = first_vertex(first);
        data_->fill(first, last, positions.data() + begin, widths.data() + begin);
    };
    data_->threads.run_ranges(strand_count(), kStrandsPerChunk, some);
}

Curves StrandShape::curves() const {
    Curves curves;
    curves.first_vertex.assign(data_->recipes.vertex.begin(), data_->recipes.vertex.end());
    curves.position.resize(vertex_count());
    curves.width.resize(vertex_count());
    fill(curves.position, curves.width);
    return curves;
}

Curves make_strands(const Groom& groom, const Frame& frame, const StrandDesc& desc,
                    std::uint32_t seed, std::uint32_t samples_per_segment, unsigned threads) {
    StrandShape shape(groom, desc, seed, samples_per_segment, {.threads = threads});
    shape.pose(frame);
    return shape.curves();
}

} // namespace mane
