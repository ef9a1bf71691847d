#include "strands/strand_layout.h"

#include "mane/error.h"

#include <algorithm>
#include <string>

namespace mane {

StrandLayout::StrandLayout(const Groom& groom, std::uint32_t strands) : first_strand_{0} {
    std::uint64_t total = 0, before = 0;
    for (std::uint32_t s : groom.strands)
        total += s;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        if (groom.sections(w) < 3)
            throw InputError("wisp " + std::to_string(w) + " has " +
                             std::to_string(groom.sections(w)) + " sections, expected at least 3");
        // Whole shares of a running sum: no wisp is off by more than one strand, and the sum is
        // exact.
        before += groom.strands[w];
        first_strand_.push_back(total ? static_cast<std::size_t>(before * strands / total) : 0);
    }
}

std::size_t StrandLayout::wisp_of(std::size_t strand) const {
    const auto behind =
        std::upper_bound(first_strand_.begin() + 1, first_strand_.end() - 1, strand);
    return static_cast<std::size_t>(behind - first_strand_.begin()) - 1;
}

} // namespace mane
