#pragma once

/// Transcendental functions made of exact operations only: the same bits on every machine and C
/// library (M39). Nothing between the scene and the state may use the library's own.

namespace mane {

double sine(double x);                  ///< |x| < 1e6; error under 1e-15
double cosine(double x);                ///< |x| < 1e6; error under 1e-15
double arc_tangent(double y, double x); ///< angle of (x, y) in (−π, π]; error under 1e-14
double arc_cosine(double x);            ///< in [0, π]; x is clamped to [−1, 1]
double exponential(double x);           ///< relative error under 1e-14; 0 under −745
double logarithm(double x);             ///< natural, x > 0; relative error under 1e-14
double power(double x, double p);       ///< x > 0; relative error under 1e-12
double cube_root(double x);

inline constexpr double kPi = 3.14159265358979323846;

inline double sine_of_degrees(double degrees) {
    return sine(degrees * (kPi / 180));
}

} // namespace mane
