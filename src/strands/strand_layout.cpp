#include "strands/strand_layout.h"

#include "mane/error.h"

#include <algorithm>

namespace mane {

StrandLayout::StrandLayout(const Groom& groom, std::uint32_t strands,
                           std::uint32_t samples_per_segment)
    : samples_(samples_per_segment) {
    if (samples_ == 0)
        throw InputError("strands need at least 1 sample per segment, found 0");
    std::uint64_t total = 0, before = 0;
    for (std::uint32_t s : groom.strands)
        total += s;

    Wisp next;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        if (groom.sections(w) < 3)
            throw InputError("wisp " + std::to_string(w) + " has " +
                             std::to_string(groom.sections(w)) + " sections, expected at least 3");
        next.vertices = samples_ * (groom.sections(w) - 1) + 1;
        wisps_.push_back(next);
        before += groom.strands[w];
        // Whole shares of a running sum: no wisp is off by more than one strand, and the sum is
        // exact.
        const std::size_t end = total ? static_cast<std::size_t>(before * strands / total) : 0;
        next.first_vertex += (end - next.first_strand) * next.vertices;
        next.first_strand = end;
    }
    next.vertices = 0;
    wisps_.push_back(next);
}

std::size_t StrandLayout::wisp_of(std::size_t strand) const {
    const auto behind =
        std::upper_bound(wisps_.begin(), wisps_.end() - 1, strand,
                         [](std::size_t s, const Wisp& w) { return s < w.first_strand; });
    return static_cast<std::size_t>(behind - wisps_.begin()) - 1;
}

std::size_t StrandLayout::first_vertex(std::size_t strand) const {
    if (strand >= strand_count())
        return vertex_count();
    const Wisp& w = wisps_[wisp_of(strand)];
    return w.first_vertex + (strand - w.first_strand) * w.vertices;
}

} // namespace mane
