#include "interactions/character_planes.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr std::size_t kMostPlanes = 3;
constexpr double kOnSurface = 1e-4; // [m] nearer than this, the way to the nearest place says
                                    // nothing; the polygon's normal does
constexpr double kSame =
    0.966; // cos 15°: a plane leaning less than this from a nearer one is taken up by it
constexpr double kAlike = 1e-3; // [m] as far as it is no farther off than this
constexpr double kPinch = -0.5; // surfaces facing each other within 60° pinch

/// The normal of a contact's plane: the way from the surface to the point (the polygon's normal
/// over a face, turning evenly round an edge or a corner), leaned toward the smooth normal, so that
/// sliding from facet to facet does not jolt. The lean is bounded: over the farthest that the point
/// may slide in the block, plane and surface part by at most half the push-out, so the plane
/// neither holds the point out of open space nor lets it sink under a facet by more than the next
/// reaction gives back. At creases there is no lean (Surface::smooth_normal).
Vec3d plane_normal(const Vec3d& away, const Vec3d& smooth, double slide, double push_out) {
    const double along = dot(away, smooth);
    if (along <= 0)
        return away;
    const Vec3d lean = smooth * (1 / along) - away;
    const double size = length(lean), most = push_out / (2 * slide);
    return normalized(away + lean * (size > most ? most / size : 1.0));
}

} // namespace

Vec3d velocity_at(const Surface& surface, const SurfacePlace& place) {
    const Triangle end = surface.end().triangle(place.triangle);
    const Vec3d& b = place.closest.barycentric;
    return (end.a * b.x + end.b * b.y + end.c * b.z - place.closest.point) / surface.duration();
}

const std::vector<NearPlane>& PlaneFinder::find(const Surface& surface, const Approach& approach) {
    const double block = surface.duration();
    const double slide = approach.slide(block);
    found_.clear();
    planes_.clear();
    surface.start().local(approach.position, approach.reach(block), rows_, around_);
    for (const SurfacePlace& place : around_) {
        const double distance = std::sqrt(place.closest.squared);
        const Vec3d outward = surface.start().normal(place.triangle);
        const Vec3d away =
            distance < kOnSurface ? outward : (approach.position - place.closest.point) / distance;
        if (dot(away, outward) <= 0)
            continue; // the back of a thin part, or a wall inside the body
        const double closing =
            std::max(0.0, dot(velocity_at(surface, place) - approach.velocity, away));
        if (distance > approach.threshold + (closing + kAcceleration * block) * block)
            continue;
        const Vec3d normal =
            plane_normal(away, surface.smooth_normal(place), slide, approach.push_out);
        found_.push_back({place, normal, distance, approach.threshold});
    }
    std::sort(found_.begin(), found_.end(), [](const NearPlane& a, const NearPlane& b) {
        return a.distance != b.distance ? a.distance < b.distance
                                        : a.place.triangle < b.place.triangle;
    });
    for (const NearPlane& plane : found_) {
        if (planes_.size() == kMostPlanes)
            break;
        if (!implied(plane) && reachable(surface, approach, plane))
            planes_.push_back(blended(plane));
    }
    halve_pinched_gaps();
    return planes_;
}

bool PlaneFinder::implied(const NearPlane& plane) const {
    return std::any_of(planes_.begin(), planes_.end(), [&](const NearPlane& nearer) {
        return dot(nearer.normal, plane.normal) > kSame;
    });
}

// In a shallow hollow a point is held by two facets. As it goes from one to the other, the plane
// turns: switched, it would jolt the wisp that leans on it.
NearPlane PlaneFinder::blended(const NearPlane& plane) const {
    Vec3d sum = plane.normal;
    for (const NearPlane& other : found_) {
        const double farther = other.distance - plane.distance;
        if (farther >= 0 && farther < kAlike && other.place.triangle != plane.place.triangle &&
            dot(other.normal, plane.normal) > kSame)
            sum += other.normal * (1 - farther / kAlike);
    }
    NearPlane turned = plane;
    turned.normal = normalized(sum);
    return turned;
}

// The nearest place of all is in sight; a farther one may be a wall that lies inside another part
// of the body.
bool PlaneFinder::reachable(const Surface& surface, const Approach& approach,
                            const NearPlane& plane) const {
    if (planes_.empty())
        return true;
    const Vec3d way = plane.place.closest.point - approach.position;
    return !surface.start().crosses(approach.position, approach.position + way * 0.999);
}

// Between two surfaces nearer to each other than twice the threshold, each keeps to its half of the
// gap (M33): the point comes to rest in the middle instead of being held off by both.
void PlaneFinder::halve_pinched_gaps() {
    for (std::size_t i = 0; i < planes_.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (dot(planes_[i].normal, planes_[j].normal) > kPinch)
                continue;
            const double half = (planes_[i].distance + planes_[j].distance) / 2;
            planes_[i].threshold = std::min(planes_[i].threshold, half);
            planes_[j].threshold = std::min(planes_[j].threshold, half);
        }
    }
}

} // namespace mane
