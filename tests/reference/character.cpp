/// §4.2: "the part of the relative velocity approaching the point-mass to the surface is
/// eliminated. A viscous drag is added between the tangential velocity of the wisp point-mass with
/// respect to the surface and the velocity of the polygon."

#include "reference/character.h"

#include <algorithm>
#include <cmath>

namespace mane::reference {
namespace {

constexpr int kSweeps = 24;
constexpr double kSettled = 1e-6; // [m/s]

/// A half line with the share that a body point has of it.
struct Ray {
    std::size_t k;
    double share;
    Vec3d d;
};

/// A body point's part in one section.
struct Lever {
    std::size_t section;
    double weight;
    std::vector<Ray> rays;
};

std::vector<Lever> levers_of(const Wisp& wisp, const BodyPoint& point) {
    const std::vector<SectionFrame> frames = section_frames(wisp);
    const auto lever = [&](std::size_t i, double weight) {
        const std::size_t K = wisp.points(), next = (point.k + 1) % K;
        return Lever{i,
                     weight,
                     {{point.k, point.alpha, half_line(frames[i], point.k, K)},
                      {next, point.beta, half_line(frames[i], next, K)}}};
    };
    std::vector<Lever> levers = {lever(point.section, 1 - point.along)};
    if (point.along > 0)
        levers.push_back(lever(point.section + 1, point.along));
    return levers;
}

bool simulated(std::size_t section) {
    return section >= 2;
}

/// What is left of an impulse on the lever for the skeleton point, when the envelope points have
/// taken their parts (M27). In reverse: how the skeleton point's motion moves the body point while
/// each ṙ + ẋ·d is kept.
Vec3d across_rays(const Lever& lever, const Vec3d& a) {
    Vec3d rest = a;
    for (const Ray& ray : lever.rays)
        rest -= ray.share * dot(ray.d, a) * ray.d;
    return rest;
}

/// What an impulse along the unit vector e meets at the body point [1/kg]: e·W e.
double inverse_mass(const Wisp& wisp, const BodyPoint& point, const Vec3d& e) {
    const std::vector<SectionFrame> frames = section_frames(wisp);
    double sum = 0;
    for (const Lever& lever : levers_of(wisp, point)) {
        if (!simulated(lever.section))
            continue;
        const Vec3d rest = across_rays(lever, e);
        const Matrix3 T = section_inertia(wisp, frames[lever.section], lever.section);
        double here = dot(rest, T.inverse() * rest);
        for (const Ray& ray : lever.rays) {
            const double along = ray.share * dot(ray.d, e);
            here += along * along / wisp.envelope_mass[lever.section];
        }
        sum += lever.weight * lever.weight * here;
    }
    return sum;
}

void push(Wisp& wisp, const BodyPoint& point, const Vec3d& J) {
    const std::vector<SectionFrame> frames = section_frames(wisp);
    for (const Lever& lever : levers_of(wisp, point)) {
        const std::size_t i = lever.section;
        if (!simulated(i))
            continue;
        for (const Ray& ray : lever.rays)
            wisp.r_rate[i][ray.k] +=
                lever.weight * ray.share * dot(ray.d, J) / wisp.envelope_mass[i];
        const Vec3d change =
            section_inertia(wisp, frames[i], i).inverse() * (lever.weight * across_rays(lever, J));
        wisp.v[i] += change;
        for (std::size_t k = 0; k < wisp.points(); ++k)
            wisp.r_rate[i][k] -= dot(change, half_line(frames[i], k, wisp.points()));
    }
}

/// A plane as its point meets it.
struct Meeting {
    Vec3d normal;
    Vec3d velocity; ///< of the plane, where the point stands over it
    double distance;
};

Meeting meet(const Wisp& wisp, const SlidingPlane& plane) {
    const Vec3d n = normalized(plane.normal);
    const Vec3d turning =
        (plane.normal_rate - dot(plane.normal_rate, n) * n) / length(plane.normal);
    const Vec3d from_anchor = position_of(wisp, plane.point) - plane.anchor;
    // d/dt (p − a)·n = (ṗ − ȧ)·n + (p − a)·ṅ
    return {n, plane.anchor_velocity - dot(from_anchor, turning) * n, dot(from_anchor, n)};
}

bool on_axis(const BodyPoint& point) {
    return point.alpha == 0 && point.beta == 0;
}

/// The planes that drag each section, and each axis between two sections: of those that touch it,
/// the skeleton point's, then the nearest. Empty where none does.
struct Touching {
    std::vector<const SlidingPlane*> section, between;

    Touching(const Wisp& wisp, const std::vector<SlidingPlane>& planes)
        : section(wisp.sections(), nullptr), between(wisp.sections(), nullptr) {
        for (const SlidingPlane& plane : planes) {
            if (meet(wisp, plane).distance >= plane.threshold)
                continue;
            const SlidingPlane*& best =
                (plane.point.along > 0 ? between : section)[plane.point.section];
            if (!best || goes_before(wisp, plane, *best))
                best = &plane;
        }
    }
    static bool goes_before(const Wisp& wisp, const SlidingPlane& a, const SlidingPlane& b) {
        if (on_axis(a.point) != on_axis(b.point))
            return on_axis(a.point);
        return meet(wisp, a).distance < meet(wisp, b).distance;
    }
};

/// Viscous drag of a section's skeleton point toward the polygon's velocity, e^(−c Δt): once,
/// whether it touches by one point or by ten.
void drag_by(Wisp& wisp, const SlidingPlane& plane, double friction_time) {
    BodyPoint axis;
    axis.section = plane.point.section;
    axis.along = plane.point.along;
    const Meeting m = meet(wisp, plane);
    const Vec3d relative = velocity_of(wisp, axis) - m.velocity;
    const Vec3d sliding = relative - dot(relative, m.normal) * m.normal;
    if (length(sliding) < 1e-6)
        return;
    const Vec3d along = normalized(sliding);
    const double mass = inverse_mass(wisp, axis, along);
    if (mass > 0)
        push(wisp, axis, std::expm1(-friction_time) * length(sliding) / mass * along);
}

void drag(Wisp& wisp, const std::vector<SlidingPlane>& planes, double friction_time) {
    const Touching touching(wisp, planes);
    for (std::size_t i = 0; i < wisp.sections(); ++i) {
        if (touching.section[i])
            drag_by(wisp, *touching.section[i], friction_time);
        const bool alone =
            !touching.section[i] && i + 1 < wisp.sections() && !touching.section[i + 1];
        if (touching.between[i] && alone)
            drag_by(wisp, *touching.between[i], friction_time);
    }
}

/// Takes the approaching part, from afar too what would pass the threshold within the step (ours).
/// `given` is what the plane has pushed so far: it may be taken back when the other planes have
/// made it needless, but a plane never pulls. Returns the change of velocity.
double stop_approach(Wisp& wisp, const SlidingPlane& plane, double h, double& given) {
    const Meeting m = meet(wisp, plane);
    const double mass = inverse_mass(wisp, plane.point, m.normal);
    if (mass == 0)
        return 0;
    const double closing = dot(velocity_of(wisp, plane.point) - m.velocity, m.normal);
    const double gap = std::max(0.0, m.distance - plane.threshold);
    const double least = -gap / h * std::min(1.0, gap / 1e-4); // softly over the last 0.1 mm
    const double asked = std::max(0.0, given + (least - closing) / mass);
    const double change = asked - given;
    push(wisp, plane.point, change * m.normal);
    given = asked;
    return std::abs(change) * mass;
}

/// A plastic impact of all planes together: of the velocities that no plane forbids, the nearest to
/// what was, measured by the masses. Found by going through the planes until nothing changes.
void stop_approaches(Wisp& wisp, const std::vector<SlidingPlane>& planes, double h) {
    std::vector<double> given(planes.size(), 0.0);
    double largest = 1;
    for (int sweep = 0; sweep < kSweeps && largest > kSettled; ++sweep) {
        largest = 0;
        for (std::size_t i = 0; i < planes.size(); ++i)
            largest = std::max(largest, stop_approach(wisp, planes[i], h, given[i]));
    }
}

} // namespace

Vec3d position_of(const Wisp& wisp, const BodyPoint& point) {
    Vec3d sum;
    for (const Lever& lever : levers_of(wisp, point)) {
        Vec3d p = wisp.x[lever.section];
        for (const Ray& ray : lever.rays)
            p += ray.share * wisp.r[lever.section][ray.k] * ray.d;
        sum += lever.weight * p;
    }
    return sum;
}

Vec3d velocity_of(const Wisp& wisp, const BodyPoint& point) {
    Vec3d sum;
    for (const Lever& lever : levers_of(wisp, point)) {
        Vec3d v = wisp.v[lever.section];
        for (const Ray& ray : lever.rays)
            v += ray.share * wisp.r_rate[lever.section][ray.k] * ray.d;
        sum += lever.weight * v;
    }
    return sum;
}

void slide(Wisp& wisp, const std::vector<SlidingPlane>& planes, const CharacterContactDesc& desc,
           double h) {
    drag(wisp, planes, static_cast<double>(desc.friction) * h);
    stop_approaches(wisp, planes, h);
}

void shift(Wisp& wisp, const std::vector<Shift>& shifts) {
    for (const Shift& s : shifts) {
        wisp.x[s.section] = s.position;
        wisp.r[s.section] = s.radii;
    }
}

} // namespace mane::reference
