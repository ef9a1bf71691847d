#include "base/functions.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <initializer_list>

namespace mane {
namespace {

// Taylor polynomials on [−π/4, π/4]: the next term is under 1e-17.
double sine_near_zero(double x) {
    const double y = x * x;
    double p = 1.0 / 355687428096000.0;
    p = p * y - 1.0 / 1307674368000.0;
    p = p * y + 1.0 / 6227020800.0;
    p = p * y - 1.0 / 39916800.0;
    p = p * y + 1.0 / 362880.0;
    p = p * y - 1.0 / 5040.0;
    p = p * y + 1.0 / 120.0;
    p = p * y - 1.0 / 6.0;
    return x + x * y * p;
}

double cosine_near_zero(double x) {
    const double y = x * x;
    double p = 1.0 / 20922789888000.0;
    p = p * y - 1.0 / 87178291200.0;
    p = p * y + 1.0 / 479001600.0;
    p = p * y - 1.0 / 3628800.0;
    p = p * y + 1.0 / 40320.0;
    p = p * y - 1.0 / 720.0;
    p = p * y + 1.0 / 24.0;
    return 1.0 - 0.5 * y + y * y * p;
}

// π/2 in two parts: the product with a small integer is exact in the first.
struct Quadrant {
    int index;
    double rest;
};
Quadrant quadrant(double x) {
    const double n = std::floor(x * (2.0 / kPi) + 0.5);
    const double high = 1.57079632673412561417e+00;
    const double low = 6.07710050650619224932e-11;
    return {static_cast<int>(static_cast<std::int64_t>(n) & 3), (x - n * high) - n * low};
}

// atan on [0, tan π/8] by its series in a half-angle: converges as 0.2⁻²ⁿ after one halving.
double arc_tangent_small(double t) {
    const double h = t / (1.0 + std::sqrt(1.0 + t * t)); // tan of half the angle, under 0.2
    const double y = h * h;
    double p = 0.0;
    for (int k = 23; k >= 1; k -= 2)
        p = 1.0 / k - y * p;
    return 2.0 * h * p;
}

double arc_tangent_positive(double t) { // t in [0, 1]
    const double tan_eighth = 0.41421356237309504880;
    if (t <= tan_eighth)
        return arc_tangent_small(t);
    return kPi / 4 + arc_tangent_small((t - 1.0) / (t + 1.0));
}

} // namespace

double sine(double x) {
    const Quadrant q = quadrant(x);
    const double s = (q.index & 1) ? cosine_near_zero(q.rest) : sine_near_zero(q.rest);
    return (q.index & 2) ? -s : s;
}

double cosine(double x) {
    const Quadrant q = quadrant(x);
    const double c = (q.index & 1) ? sine_near_zero(q.rest) : cosine_near_zero(q.rest);
    return (q.index == 1 || q.index == 2) ? -c : c;
}

double arc_tangent(double y, double x) {
    const double ax = std::fabs(x), ay = std::fabs(y);
    if (ax == 0.0 && ay == 0.0)
        return 0.0;
    const double a =
        ax >= ay ? arc_tangent_positive(ay / ax) : kPi / 2 - arc_tangent_positive(ax / ay);
    const double upper = x < 0.0 ? kPi - a : a;
    return y < 0.0 ? -upper : upper;
}

double arc_cosine(double x) {
    const double c = x > 1.0 ? 1.0 : x < -1.0 ? -1.0 : x;
    return arc_tangent(std::sqrt((1.0 - c) * (1.0 + c)), c);
}

double exponential(double x) {
    if (x < -745.0)
        return 0.0;
    if (x > 709.0)
        return HUGE_VAL;
    const double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
    const double n = std::floor(x / 0.69314718055994530942 + 0.5);
    const double r = (x - n * ln2_high) - n * ln2_low; // |r| ≤ ln 2 / 2
    // Taylor's series, its coefficients folded by the compiler: a division per term would take five
    // times as long.
    double p = 1.0 / 1307674368000.0;
    for (double c : {1.0 / 87178291200.0, 1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0,
                     1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0, 1.0 / 5040.0, 1.0 / 720.0,
                     1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5, 1.0, 1.0})
        p = p * r + c;
    return std::ldexp(p, static_cast<int>(n));
}

double logarithm(double x) {
    int e = 0;
    double m = std::frexp(x, &e); // [½, 1)
    if (m < 0.70710678118654752440) {
        m *= 2.0;
        --e;
    }
    const double h = (m - 1.0) / (m + 1.0), y = h * h; // |h| < 0.172
    double p = 0.0;
    for (int k = 21; k >= 1; k -= 2)
        p = 1.0 / k + y * p;
    return 2.0 * h * p + e * 0.69314718055994530942;
}

double power(double x, double p) {
    if (p == 0.0)
        return 1.0;
    if (p == 1.0)
        return x;
    if (p == 2.0)
        return x * x;
    return exponential(p * logarithm(x));
}

double cube_root(double x) {
    if (x == 0.0)
        return 0.0;
    const double a = power(std::fabs(x), 1.0 / 3.0);
    return x < 0.0 ? -a : a;
}

} // namespace mane
