#include "interactions/contact_matrix.h"

#include "base/functions.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

/// 3τ² − 2τ³, from 0 at `low` to 1 at `high`.
double smooth_step(double x, double low, double high) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// 1 − e^−y for y ≥ 0.
double lost(double y) {
    if (y > 0.125)
        return 1 - exponential(-y);
    // Taylor's series, its first term left out under 1e-12 of the sum: contacts ask this every
    // block.
    double p = -1.0 / 40320;
    for (double c : {1.0 / 5040, -1.0 / 720, 1.0 / 120, -1.0 / 24, 1.0 / 6, -0.5, 1.0})
        p = p * y + c;
    return p * y;
}

} // namespace

ContactMatrix::ContactMatrix(const WispContactDesc& desc, float step)
    : friction_(double{desc.friction} * double{step}), sine_fade_(sine_of_degrees(desc.fade_angle)),
      sine_full_(sine_of_degrees(double{desc.parallel_angle} * 2 / 3)),
      sine_none_(sine_of_degrees(desc.parallel_angle)) {}

Symmetric3d ContactMatrix::impulse_per_velocity(const ContactInput& input) const {
    Symmetric3d w;
    double across = 0;
    for (const ContactEnd& end : input.ends) {
        if (!end.mass)
            continue;
        across += double{end.mass->across} * double{end.share};
        w += Symmetric3d::outer(Vec3d(end.mass->normal),
                                double{end.mass->extra} * double{end.share});
    }
    w += Symmetric3d::identity(across);
    if (input.envelope > 0) // along its half line it moves with its own mass
        w += Symmetric3d::outer(Vec3d(input.half_line),
                                double{input.envelope} - double{input.ends[0].mass->across} *
                                                             double{input.ends[0].share});
    const double trace = w.trace();
    if (!(trace > 0))
        return {};
    if (input.friction)
        w += viscosity(input, trace / 3);
    return w.inverse();
}

/// Z of quasi-parallel wisps (M24, M25): weak in their plane, rigid across it as far as there is a
/// plane.
Symmetric3d ContactMatrix::viscosity(const ContactInput& input, double mean) const {
    const double f = dragged(input.density);
    const Vec3d n = cross(Vec3d(input.point_direction), Vec3d(input.segment_direction));
    const double sine_of_angle = length(n);
    const double fade = smooth_step(sine_of_angle, 0.5 * sine_fade_, sine_fade_);
    const double f_out = f + (1 - f) * fade;
    const double in = mean * sliding_weight(sine_of_angle) * (1 - f) / f,
                 out = mean * (1 - f_out) / f_out;
    Symmetric3d z = Symmetric3d::identity(in);
    if (fade > 0)
        z += Symmetric3d::outer(n, (out - in) / (sine_of_angle * sine_of_angle));
    return z;
}

double ContactMatrix::dragged(float density) const {
    constexpr double kLeast = 1e-6; // no friction at all would be an infinite Z
    return std::max(kLeast, lost(friction_ * double{density}));
}

/// Sliding ends smoothly at the parallel angle, where the pair becomes a collision: a wisp that
/// leans on another would else be dropped where the other's next segment turns.
double ContactMatrix::sliding_weight(double sine_of_angle) const {
    const double t = std::clamp((sine_none_ - sine_of_angle) / (sine_none_ - sine_full_), 0.0, 1.0);
    return t * t;
}

} // namespace mane
