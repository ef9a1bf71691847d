#pragma once

#include "model/state.h"

namespace mane {

/// A symmetric 3×3 matrix, and what contacts need of it.
struct Symmetric3 {
    float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

    static constexpr Symmetric3 identity(float s) { return {s, s, s, 0, 0, 0}; }
    /// s a aᵀ
    static constexpr Symmetric3 outer(const Vec3& a, float s) {
        return {s * a.x * a.x, s * a.y * a.y, s * a.z * a.z,
                s * a.x * a.y, s * a.x * a.z, s * a.y * a.z};
    }
    constexpr Symmetric3& operator+=(const Symmetric3& o) {
        xx += o.xx, yy += o.yy, zz += o.zz, xy += o.xy, xz += o.xz, yz += o.yz;
        return *this;
    }
    constexpr float trace() const { return xx + yy + zz; }
    constexpr Vec3 operator*(const Vec3& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
    /// The x for which this matrix times x is b; the matrix must be positive definite.
    Vec3 solve(const Vec3& b) const;
};

/// How a section answers impulses (docs/model.md, "Response of a point to an impulse"): T⁻¹ =
/// across·I + extra·n nᵀ for the skeleton point, 1/m for the motion of an envelope point along its
/// half line. All zero for a kinematic section.
struct SectionMass {
    float across = 0, extra = 0, envelope = 0;
    Vec3 normal;

    static SectionMass of(const HairView& hair, std::uint32_t section);
    Vec3 skeleton_response(const Vec3& impulse) const {
        return impulse * across + normal * (dot(normal, impulse) * extra);
    }
    Symmetric3 inverse() const {
        Symmetric3 w = Symmetric3::identity(across);
        w += Symmetric3::outer(normal, extra);
        return w;
    }
};

/// Direction of half line k of a section, in the world.
Vec3 half_line_direction(const HairView& hair, Slot slot, std::uint32_t k);

/// Velocity of a point of a section: the skeleton point, or an envelope point.
Vec3 skeleton_velocity(const HairView& hair, Slot slot);
Vec3 envelope_velocity(const HairView& hair, Slot slot, std::uint32_t k);

} // namespace mane
