#include "model/state.h"

#include "base/functions.h"

namespace mane {

std::vector<HalfLine> half_lines(std::uint32_t k) {
    std::vector<HalfLine> lines(k);
    for (std::uint32_t i = 0; i < k; ++i) {
        const double angle = 2 * kPi * i / k;
        lines[i] = {static_cast<float>(cosine(angle)), static_cast<float>(sine(angle))};
    }
    // The four half lines of the paper are exact: no cos(π/2) = 6e-17 in a section that should be
    // symmetric.
    if (k == 4)
        lines = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return lines;
}

} // namespace mane
