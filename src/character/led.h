#pragma once

#include "character/bust_chain.h"
#include "character/rotation.h"
#include "mane/driven.h"

namespace mane {

/// When a led body is on its way.
struct Stretch {
    double from = 0, to = 1; ///< [s]
    double seconds() const { return to - from; }
};
/// Throws InputError unless `to` is after `from`, both finite.
Stretch stretch(double from, double to);

/// A pose with a unit rotation. Throws InputError for one that is not finite or does not turn.
Quatd checked(const Quatd& rotation);
Vec3d checked(const Vec3d& position);
Pose checked(const Pose& pose);

/// A point on its way to where it is to be at the stretch's end: from `start`, where it had `rate`.
/// After the stretch it comes to rest over another one.
struct LedPoint {
    Vec3d start, rate; ///< [m], [m/s]
    Vec3d end;         ///< [m]

    static LedPoint at_rest(const Vec3d& p) { return {p, {}, p}; }
    PointMotion at(double time, const Stretch& stretch) const;
    /// The way that goes on from where the point is at `time`.
    LedPoint led(const Vec3d& to, double time, const Stretch& stretch) const;
    void jump(const Pose& by);
};

/// A rotation on its way, likewise: along the rotation vector from `start`.
struct LedTurn {
    Quatd start; ///< unit
    Vec3d rate;  ///< [rad/s] world axes
    Quatd end;   ///< unit

    static LedTurn at_rest(const Quatd& q) { return {q, {}, q}; }
    Turning at(double time, const Stretch& stretch) const;
    LedTurn led(const Quatd& to, double time, const Stretch& stretch) const;
    void jump(const Pose& by);
};

} // namespace mane
