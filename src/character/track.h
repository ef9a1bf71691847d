#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace mane {

// Some numbers and how fast they change.
template <std::size_t N> struct TrackPoint {
    std::array<double, N> value;
    std::array<double, N> rate;
};

// What a track does outside its keys. In both it is C² there and at rest in the end.
enum class TrackEnd {
    rest,  // at rest at the first and the last key
    coast, // passes them with the velocity it has, and comes to rest over half a second
};

// N numbers that pass through keys in time along a C² curve: the cubic spline, its first and last
// piece changed to quintics where it has to come to rest without a jump of acceleration (a cubic
// has no freedom left for that).
template <std::size_t N> class Track {
  public:
    using Values = std::array<double, N>;
    static constexpr double kCoastTime = 0.5; // [s]

    // At least one key; times rise strictly.
    Track(std::vector<double> times, const std::vector<Values>& values, TrackEnd end);

    TrackPoint<N> evaluate(double time) const;

  private:
    struct Key {
        Values value, rate, acceleration;
    };
    void coast_out();

    std::vector<double> times_;
    std::vector<Key> keys_;
};

extern template class Track<3>;
extern template class Track<4>;

} // namespace mane
