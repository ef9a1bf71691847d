#include "groom/matrix.h"

#include <algorithm>
#include <cmath>

namespace mane {

bool is_positive_definite(Matrix m, std::size_t band) {
    const std::size_t n = m.size();
    for (std::size_t j = 0; j < n; ++j) {
        const std::size_t first = j > band ? j - band : 0, last = std::min(n, j + band + 1);
        double pivot = m.at(j, j);
        for (std::size_t k = first; k < j; ++k)
            pivot -= m.at(j, k) * m.at(j, k);
        if (!(pivot > 1e-12 * m.at(j, j)))
            return false; // the rest is rounding
        const double root = std::sqrt(pivot);
        m.at(j, j) = root;
        for (std::size_t i = j + 1; i < last; ++i) {
            double sum = m.at(i, j);
            for (std::size_t k = first; k < j; ++k)
                sum -= m.at(i, k) * m.at(j, k);
            m.at(i, j) = sum / root;
        }
    }
    return true;
}

} // namespace mane
