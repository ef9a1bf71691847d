#include "strands/recipe.h"

#include "base/functions.h"
#include "base/random.h"
#include "strands/catmull_rom.h"

namespace mane {
namespace {

constexpr std::size_t kStrandsPerChunk = 1024; // some 300 µs

/// Fills the columns, strand by strand.
class RecipeWriter {
  public:
    RecipeWriter(StrandRecipes& recipes, const StrandDesc& desc, std::uint32_t seed,
                 const DesignedLength& designed, const DrawnEnvelope& envelope, const Waves& waves)
        : out_(recipes), desc_(desc), seed_(seed), designed_(designed), envelope_(envelope),
          waves_(waves),
          // M17: the disc leaves room for all that moves a strand outward, so that nothing has to
          // be clamped later. Curls turn it, which needs none.
          disc_radius_((1 - waves.amplitude()) / (1 + catmull_rom_overshoot(desc.jitter))) {}

    /// Strand `n` of all is number `strand` of wisp `wisp`; `left` are its pieces + 3 entries.
    void write(std::size_t n, std::size_t wisp, std::size_t strand, float* left) const {
        const Random random(seed_, wisp, strand + 1); // 0 is the wisp's own
        DiscPoint place = place_in_disc(desc_.distribution, random, kPlace);
        place = {place.x * disc_radius_, place.y * disc_radius_};
        out_.end[n] = designed_.parameter(
            wisp, designed_.whole(wisp) * (1 - desc_.length_jitter * random.unit(kLength)));
        write_left(wisp, random, left);
        write_place(n, place);
        write_end(n, wisp, place, random, left);
    }

  private:
    void write_left(std::size_t wisp, const Random& random, float* left) const {
        const std::size_t sections = designed_.pieces(wisp) + 1;
        for (std::size_t i = 0; i < sections; ++i)
            left[i + 1] = 1 - desc_.jitter * random.unit(kFirstJitter + i);
        left[0] = left[1];
        left[sections + 1] = left[sections];
    }

    void write_place(std::size_t n, DiscPoint place) const {
        if (out_.moving) {
            out_.first[n] = place.x;
            out_.second[n] = place.y;
            return;
        }
        const DrawnEnvelope::Between between = envelope_.between(place);
        out_.sector[n] = between.k;
        out_.first[n] = between.first;
        out_.second[n] = between.second;
    }

    void write_end(std::size_t n, std::size_t wisp, DiscPoint place, const Random& random,
                   const float* left) const {
        const AlongWisp at = designed_.along(wisp, out_.end[n]);
        const CatmullRomWeights weights(at.t);
        const float share = weights.at(left + at.piece);
        out_.end_piece[n] = static_cast<float>(at.piece);
        for (std::size_t j = 0; j < 4; ++j)
            out_.end_weight[j][n] = weights.of[j];
        const double length = double{designed_.to(wisp, at)};
        const double turn = designed_.turn(wisp, double{desc_.curls}, length);
        const auto c = static_cast<float>(cosine(turn)), s = static_cast<float>(sine(turn));
        out_.end_x[n] = (place.x * c - place.y * s) * share;
        out_.end_y[n] = (place.x * s + place.y * c) * share;
        if (waves_.amplitude() == 0)
            return;
        const double own =
            double{random.between(kPhase, -Waves::kPhaseSpread, Waves::kPhaseSpread)};
        out_.phase_cosine[n] = static_cast<float>(cosine(own));
        out_.phase_sine[n] = static_cast<float>(sine(own));
        out_.end_wave[n] = static_cast<float>(sine(waves_.phase(wisp, length) + own));
    }

    StrandRecipes& out_;
    const StrandDesc& desc_;
    std::uint32_t seed_;
    const DesignedLength& designed_;
    const DrawnEnvelope& envelope_;
    const Waves& waves_;
    float disc_radius_;
};

} // namespace

StrandRecipes::StrandRecipes(const StrandDesc& desc, std::uint32_t seed, const StrandLayout& layout,
                             const DesignedLength& designed, const DrawnEnvelope& envelope,
                             const Waves& waves, const VertexGrid& grid, Threads& threads)
    : moving(waves.amplitude() > 0 || desc.curls != 0), jittered(desc.jitter > 0) {
    const std::size_t strands = layout.strand_count();
    for (Column<float>* column :
         {&first, &second, &phase_cosine, &phase_sine, &end, &end_x, &end_y, &end_wave, &end_piece,
          &end_weight[0], &end_weight[1], &end_weight[2], &end_weight[3]})
        column->resize(strands + kPadding);
    sector.resize(strands);
    vertex.resize(strands + 1);
    std::size_t size = 0;
    for (std::size_t w = 0; w < layout.wisp_count(); ++w) {
        first_left.push_back(size);
        size += (layout.first_strand(w + 1) - layout.first_strand(w)) * (designed.pieces(w) + 3);
    }
    left.resize(size + DrawnEnvelope::kPadding);

    const RecipeWriter writer(*this, desc, seed, designed, envelope, waves);
    threads.run_ranges(strands, kStrandsPerChunk, [&](std::size_t begin, std::size_t behind) {
        std::size_t w = layout.wisp_of(begin);
        for (std::size_t n = begin; n < behind; ++n) {
            while (n >= layout.first_strand(w + 1))
                ++w;
            const std::size_t strand = n - layout.first_strand(w);
            writer.write(n, w, strand,
                         left.data() + first_left[w] + strand * (designed.pieces(w) + 3));
            vertex[n + 1] = grid.before(end[n]) + 1;
        }
    });
    for (std::size_t n = 0; n < strands; ++n)
        vertex[n + 1] += vertex[n];
}

} // namespace mane
