#include "character/low_pass.h"

#include "base/functions.h"

#include <cmath>

namespace mane {
namespace {

// Weights 0 … radius of the symmetric kernel, sum (both sides) one. Beyond five deviations they are
// under 4e-6 of the largest.
std::vector<double> gaussian_kernel(double width) {
    const auto radius = static_cast<std::size_t>(std::floor(5 * width)) + 1;
    std::vector<double> weights(radius + 1);
    double sum = 0;
    for (std::size_t k = 0; k <= radius; ++k) {
        const double x = static_cast<double>(k) / width;
        weights[k] = exponential(-0.5 * x * x);
        sum += (k == 0 ? 1 : 2) * weights[k];
    }
    for (double& w : weights)
        w /= sum;
    return weights;
}

// Sample i of the signal continued beyond its ends, by reflection in its end points.
template <std::size_t N> std::array<double, N>
continued(const std::vector<std::array<double, N>>& samples, std::ptrdiff_t i) {
    const auto last = static_cast<std::ptrdiff_t>(samples.size()) - 1;
    if (i >= 0 && i <= last)
        return samples[static_cast<std::size_t>(i)];
    if (last == 0)
        return samples[0];
    const std::ptrdiff_t end = i < 0 ? 0 : last;
    const std::array<double, N> mirrored = continued(samples, 2 * end - i);
    std::array<double, N> x = samples[static_cast<std::size_t>(end)];
    for (std::size_t c = 0; c < N; ++c)
        x[c] = 2 * x[c] - mirrored[c];
    return x;
}

} // namespace

double gaussian_width(double cutoff, double rate) {
    return std::sqrt(logarithm(2.0)) / (2 * kPi * cutoff) * rate;
}

template <std::size_t N>
void gaussian_low_pass(std::vector<std::array<double, N>>& samples, double width) {
    const std::vector<double> weights = gaussian_kernel(width);
    const std::vector<std::array<double, N>> raw = samples;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        for (double& x : samples[i])
            x *= weights[0];
        for (std::size_t k = 1; k < weights.size(); ++k) {
            const auto at = static_cast<std::ptrdiff_t>(i), step = static_cast<std::ptrdiff_t>(k);
            const auto before = continued(raw, at - step), after = continued(raw, at + step);
            for (std::size_t c = 0; c < N; ++c)
                samples[i][c] += weights[k] * (before[c] + after[c]);
        }
    }
}

template void gaussian_low_pass<3>(std::vector<std::array<double, 3>>&, double);
template void gaussian_low_pass<4>(std::vector<std::array<double, 4>>&, double);

} // namespace mane
