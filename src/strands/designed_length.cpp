#include "strands/designed_length.h"

namespace mane {

DesignedLength::DesignedLength(const Groom& groom)
    : first_section_(groom.first_section), to_section_(groom.section_count()) {
    const auto segment = [&](std::size_t s) {
        return length(groom.position[s + 1] - groom.position[s]);
    };
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        const std::size_t first = groom.first_section[w];
        to_section_[first] = -segment(first);
        for (std::size_t s = first + 2; s < groom.first_section[w + 1]; ++s)
            to_section_[s] = to_section_[s - 1] + segment(s - 1);
    }
}

float DesignedLength::parameter(std::size_t wisp, float length) const {
    const auto first = to_section_.begin() + first_section_[wisp],
               behind = to_section_.begin() + first_section_[wisp + 1];
    const auto next = std::clamp(std::lower_bound(first, behind, length), first + 2, behind - 1);
    const float segment = *next - *(next - 1);
    const float t = segment > 0 ? std::clamp((length - *(next - 1)) / segment, 0.0f, 1.0f) : 1.0f;
    return static_cast<float>(next - 1 - first) + t;
}

} // namespace mane
