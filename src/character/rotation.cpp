#include "character/rotation.h"

#include "base/functions.h"

#include <cmath>

namespace mane {

Quatd turn_about_x(double angle) {
    return {sine(angle / 2), 0, 0, cosine(angle / 2)};
}
Quatd turn_about_y(double angle) {
    return {0, sine(angle / 2), 0, cosine(angle / 2)};
}
Quatd turn_about_z(double angle) {
    return {0, 0, sine(angle / 2), cosine(angle / 2)};
}

Turning turning_inside(const Turning& outer, const Turning& inner) {
    return {outer.rotation * inner.rotation,
            outer.angular_velocity + outer.rotation.rotate(inner.angular_velocity)};
}

Turning turning_of(const TrackPoint<4>& point) {
    const auto& [x, y, z, w] = point.value;
    const double size = std::sqrt(x * x + y * y + z * z + w * w);
    const Quatd q{x / size, y / size, z / size, w / size};
    // ω = 2 q̇ q*, its vector part: the share of the rate along q, the change of size, only reaches
    // the scalar part.
    const auto& [rx, ry, rz, rw] = point.rate;
    const Quatd spin = Quatd{rx / size, ry / size, rz / size, rw / size} * q.conjugate();
    return {q, Vec3d(spin.x, spin.y, spin.z) * 2.0};
}

void align_signs(std::vector<std::array<double, 4>>& rotations,
                 const std::array<double, 4>& reference) {
    const std::array<double, 4>* before = &reference;
    for (auto& q : rotations) {
        double along = 0;
        for (std::size_t c = 0; c < 4; ++c)
            along += q[c] * (*before)[c];
        if (along < 0)
            for (double& c : q)
                c = -c;
        before = &q;
    }
}

void align_signs(std::vector<std::array<double, 4>>& rotations) {
    if (rotations.empty())
        return;
    const std::array<double, 4> first = rotations.front();
    align_signs(rotations, first);
}

} // namespace mane
