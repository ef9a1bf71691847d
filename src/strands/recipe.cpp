#include "strands/recipe.h"

#include <algorithm>

namespace mane {

StrandRecipes::StrandRecipes(const Groom& groom, const StrandDesc& desc, std::uint32_t seed,
                             float wave_amplitude)
    : desc_(desc), seed_(seed), first_section_(groom.first_section) {
    // M17: the disc leaves room for all that moves a strand outward, so that nothing has to be
    // clamped later.
    disc_radius_ = (1 - wave_amplitude) / (1 + catmull_rom_overshoot(desc.jitter));
    arc_.resize(groom.section_count());
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        for (std::size_t s = groom.first_section[w] + 2; s < groom.first_section[w + 1]; ++s)
            arc_[s] = arc_[s - 1] + length(groom.position[s] - groom.position[s - 1]);
}

void StrandRecipes::make(std::size_t wisp, std::size_t strand, StrandRecipe& recipe) const {
    const Random random(seed_, wisp, strand + 1); // 0 is the wisp's own
    const DiscPoint place = place_in_disc(desc_.distribution, random, kPlace);
    recipe.place = {place.x * disc_radius_, place.y * disc_radius_};
    recipe.end = designed_end(wisp, 1 - desc_.length_jitter * random.unit(kLength));
    recipe.phase = random.between(kPhase, -Waves::kPhaseSpread, Waves::kPhaseSpread);

    const std::size_t last = first_section_[wisp + 1] - first_section_[wisp] - 1;
    const auto left = [&](std::size_t i) {
        return 1 - desc_.jitter * random.unit(kFirstJitter + i);
    };
    recipe.share.clear();
    for (std::size_t i = 0; i < last; ++i)
        recipe.share.push_back(catmull_rom_piece(left, i, last));
}

// Where a strand ends that has the given share of the designed length from x₁ on: in the material,
// so that it does not slide along its wisp when segments stretch.
float StrandRecipes::designed_end(std::size_t wisp, float share) const {
    const auto first = arc_.begin() + first_section_[wisp],
               behind = arc_.begin() + first_section_[wisp + 1];
    const float length = *(behind - 1) * share;
    const auto next = std::clamp(std::lower_bound(first, behind, length), first + 2, behind - 1);
    const float segment = *next - *(next - 1);
    const float t = segment > 0 ? std::clamp((length - *(next - 1)) / segment, 0.0f, 1.0f) : 1.0f;
    return static_cast<float>(next - 1 - first) + t;
}

} // namespace mane
