#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace mane {

// The standard deviation [samples] of the Gaussian whose gain at `cutoff` [Hz] is √½ (−3 dB), for
// samples at `rate` [Hz].
double gaussian_width(double cutoff, double rate);

// Convolves the samples with a Gaussian of standard deviation `width` [samples], sampled and
// normalised. Beyond its ends the signal is continued by point reflection, so that a steady
// velocity passes unchanged; repeating the last sample would brake it.
template <std::size_t N>
void gaussian_low_pass(std::vector<std::array<double, N>>& samples, double width);

extern template void gaussian_low_pass<3>(std::vector<std::array<double, 3>>&, double);
extern template void gaussian_low_pass<4>(std::vector<std::array<double, 4>>&, double);

} // namespace mane
