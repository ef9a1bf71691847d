#include "character/led.h"

#include "base/functions.h"
#include "mane/error.h"

#include <cmath>
#include <string>

namespace mane {
namespace {

// A vector and its rate by s, from 0 at `rate` to `way` at s = 1: way(1) has the rate `way`, and
// there is no acceleration at either end.
struct Led {
    Vec3d value, rate;

    Led(const Vec3d& rate_, const Vec3d& way, double s) {
        const Vec3d lacking = way - rate_;
        value = rate_ * s + lacking * (s * s * s * (6 + s * (3 * s - 8)));
        rate = rate_ + lacking * (s * s * (18 + s * (15 * s - 32)));
    }
};

// Where a way is at a time: on its first stretch, or on the second, over which it comes to rest.
struct Place {
    double s;
    enum { before, on_the_way, coming_to_rest, at_rest } phase;

    Place(double time, const Stretch& stretch) : s((time - stretch.from) / stretch.seconds()) {
        phase = s < 0 ? before : time < stretch.to ? on_the_way : s < 2 ? coming_to_rest : at_rest;
        if (phase == coming_to_rest)
            s = std::fmax(0.0, s - 1);
    }
};

// The rotation about a vector by its length.
Quatd rotation_by(const Vec3d& w) {
    const double angle = length(w), half = angle / 2;
    const double share = angle < 1e-4 ? 0.5 - angle * angle / 48 : sine(half) / angle;
    return {w.x * share, w.y * share, w.z * share, cosine(half)};
}

// The shortest such vector.
Vec3d rotation_vector(const Quatd& q) {
    const double sign = q.w < 0 ? -1 : 1;
    const Vec3d axis = Vec3d(q.x, q.y, q.z) * sign;
    const double size = length(axis), w = q.w * sign;
    return axis * (size < 1e-12 ? 2 : 2 * arc_tangent(size, w) / size);
}

// The angular velocity of a rotation whose vector is w and changes at the rate w_rate.
Vec3d angular_velocity(const Vec3d& w, const Vec3d& w_rate) {
    const double square = dot(w, w), angle = std::sqrt(square);
    double a = 0.5 - square / 24, b = 1.0 / 6 - square / 120;
    if (angle > 1e-3) {
        const double half = sine(angle / 2) / angle;
        a = 2 * half * half;
        b = (1 - sine(angle) / angle) / square;
    }
    const Vec3d turned = cross(w, w_rate);
    return w_rate + turned * a + cross(w, turned) * b;
}

Turning turning_from(const Quatd& start, const Led& led, double seconds) {
    return {rotation_by(led.value) * start, angular_velocity(led.value, led.rate / seconds)};
}

bool is_finite(const Vec3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

Stretch stretch(double from, double to) {
    if (!std::isfinite(from) || !std::isfinite(to) || !(to > from))
        throw InputError("a motion led from " + std::to_string(from) + " s to " +
                         std::to_string(to) + " s; expected a time after the first");
    return {from, to};
}

Vec3d checked(const Vec3d& position) {
    if (!is_finite(position))
        throw InputError("a pose whose position is not finite");
    return position;
}

Quatd checked(const Quatd& rotation) {
    const double square = dot(rotation, rotation);
    if (!std::isfinite(square) || !(square > 0))
        throw InputError("a pose whose rotation is not finite or the zero quaternion");
    return normalized(rotation);
}

Pose checked(const Pose& pose) {
    return {checked(pose.position), checked(pose.rotation)};
}

PointMotion LedPoint::at(double time, const Stretch& stretch) const {
    const Place place(time, stretch);
    const double seconds = stretch.seconds();
    switch (place.phase) {
    case Place::before:
        return {start + rate * (time - stretch.from), rate};
    case Place::on_the_way: {
        const Led led(rate * seconds, end - start, place.s);
        return {start + led.value, led.rate / seconds};
    }
    case Place::coming_to_rest: {
        const Led led(end - start, {}, place.s);
        return {end + led.value, led.rate / seconds};
    }
    default:
        return {end, {}};
    }
}

LedPoint LedPoint::led(const Vec3d& to, double time, const Stretch& stretch) const {
    const PointMotion now = at(time, stretch);
    return {now.position, now.velocity, to};
}

void LedPoint::jump(const Pose& by) {
    start = by.rotation.rotate(start) + by.position;
    rate = by.rotation.rotate(rate);
    end = by.rotation.rotate(end) + by.position;
}

Turning LedTurn::at(double time, const Stretch& stretch) const {
    const Place place(time, stretch);
    const double seconds = stretch.seconds();
    const Vec3d way = rotation_vector(end * start.conjugate());
    switch (place.phase) {
    case Place::before:
        return {start, rate};
    case Place::on_the_way:
        return turning_from(start, Led(rate * seconds, way, place.s), seconds);
    case Place::coming_to_rest:
        return turning_from(end, Led(way, {}, place.s), seconds);
    default:
        return {end, {}};
    }
}

LedTurn LedTurn::led(const Quatd& to, double time, const Stretch& stretch) const {
    const Turning now = at(time, stretch);
    return {now.rotation, now.angular_velocity, to};
}

void LedTurn::jump(const Pose& by) {
    start = by.rotation * start;
    rate = by.rotation.rotate(rate);
    end = by.rotation * end;
}

} // namespace mane
