#include "character/track.h"

#include <algorithm>

namespace mane {
namespace {

// Second derivatives at the keys of the cubic spline through them; the ends have no velocity (rest)
// or no acceleration (coast). The tridiagonal system is diagonally dominant: elimination without
// pivots is stable.
std::vector<double> spline_accelerations(const std::vector<double>& t, const std::vector<double>& y,
                                         TrackEnd end) {
    const std::size_t n = t.size();
    std::vector<double> upper(n, 0.0), m(n, 0.0);
    if (n < 2)
        return m;
    const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / (t[i + 1] - t[i]); };
    const bool clamped = end == TrackEnd::rest;
    if (clamped) {
        upper[0] = 0.5;
        m[0] = 3 * slope(0) / (t[1] - t[0]);
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
        const double pivot = 2 * (before + after) - before * upper[i - 1];
        upper[i] = after / pivot;
        m[i] = (6 * (slope(i) - slope(i - 1)) - before * m[i - 1]) / pivot;
    }
    if (clamped) {
        const double right_side = -6 * slope(n - 2) / (t[n - 1] - t[n - 2]);
        m[n - 1] = (right_side - m[n - 2]) / (2 - upper[n - 2]);
    }
    for (std::size_t i = n - 1; i-- > 0;)
        m[i] -= upper[i] * m[i + 1];
    return m;
}

// First derivatives that belong to these second ones.
std::vector<double> spline_rates(const std::vector<double>& t, const std::vector<double>& y,
                                 const std::vector<double>& m) {
    const std::size_t n = t.size();
    std::vector<double> rates(n, 0.0);
    for (std::size_t i = 0; i + 1 < n; ++i) {
        const double h = t[i + 1] - t[i], slope = (y[i + 1] - y[i]) / h;
        rates[i] = slope - h * (2 * m[i] + m[i + 1]) / 6;
        rates[i + 1] = slope + h * (m[i] + 2 * m[i + 1]) / 6;
    }
    return rates;
}

// The quintic on [0, h] with these values, rates and accelerations at both ends: a cubic where they
// are a cubic's.
struct Quintic {
    double c0, c1, c2, c3, c4, c5;

    Quintic(double y0, double v0, double a0, double y1, double v1, double a1, double h)
        : c0(y0), c1(h * v0), c2(h * h * a0 / 2) {
        const double y = y1 - c0 - c1 - c2, v = h * v1 - c1 - 2 * c2, a = h * h * a1 - 2 * c2;
        c3 = 10 * y - 4 * v + a / 2;
        c4 = -15 * y + 7 * v - a;
        c5 = 6 * y - 3 * v + a / 2;
    }
    double value(double s) const { return c0 + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))); }
    double slope(double s) const {
        return c1 + s * (2 * c2 + s * (3 * c3 + s * (4 * c4 + s * (5 * c5))));
    }
};

} // namespace

template <std::size_t N>
Track<N>::Track(std::vector<double> times, const std::vector<Values>& values, TrackEnd end)
    : times_(std::move(times)), keys_(values.size()) {
    std::vector<double> y(values.size());
    for (std::size_t c = 0; c < N; ++c) {
        for (std::size_t i = 0; i < values.size(); ++i)
            y[i] = values[i][c];
        const std::vector<double> m = spline_accelerations(times_, y, end);
        const std::vector<double> v = spline_rates(times_, y, m);
        for (std::size_t i = 0; i < values.size(); ++i) {
            keys_[i].value[c] = y[i];
            keys_[i].rate[c] = v[i];
            keys_[i].acceleration[c] = m[i];
        }
    }
    if (end == TrackEnd::rest) {
        for (Key* key : {&keys_.front(), &keys_.back()})
            key->rate = key->acceleration = {};
    } else {
        coast_out();
    }
}

// One more key at either end, at rest, as far away as a velocity takes that fades out evenly.
template <std::size_t N> void Track<N>::coast_out() {
    Key before = keys_.front(), after = keys_.back();
    for (std::size_t c = 0; c < N; ++c) {
        before.value[c] -= before.rate[c] * kCoastTime / 2;
        after.value[c] += after.rate[c] * kCoastTime / 2;
    }
    before.rate = before.acceleration = after.rate = after.acceleration = {};
    keys_.insert(keys_.begin(), before);
    keys_.push_back(after);
    times_.insert(times_.begin(), times_.front() - kCoastTime);
    times_.push_back(times_.back() + kCoastTime);
}

template <std::size_t N> TrackPoint<N> Track<N>::evaluate(double time) const {
    if (!(time > times_.front()))
        return {keys_.front().value, {}};
    if (!(time < times_.back()))
        return {keys_.back().value, {}};
    const auto after = std::upper_bound(times_.begin(), times_.end(), time);
    const auto i = static_cast<std::size_t>(after - times_.begin()) - 1;
    const double h = times_[i + 1] - times_[i], s = (time - times_[i]) / h;
    const Key &k = keys_[i], &l = keys_[i + 1];
    TrackPoint<N> point;
    for (std::size_t c = 0; c < N; ++c) {
        const Quintic q(k.value[c], k.rate[c], k.acceleration[c], l.value[c], l.rate[c],
                        l.acceleration[c], h);
        point.value[c] = q.value(s);
        point.rate[c] = q.slope(s) / h;
    }
    return point;
}

template class Track<3>;
template class Track<4>;

} // namespace mane
