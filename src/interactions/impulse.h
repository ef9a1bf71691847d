#pragma once

#include "model/state.h"

namespace mane {

/// A symmetric 3×3 matrix, and what contacts need of it.
template <typename T> struct Symmetric3T {
    T xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;

    static constexpr Symmetric3T identity(T s) { return {s, s, s, 0, 0, 0}; }
    /// s a aᵀ
    static constexpr Symmetric3T outer(const Vec3T<T>& a, T s) {
        return {s * a.x * a.x, s * a.y * a.y, s * a.z * a.z,
                s * a.x * a.y, s * a.x * a.z, s * a.y * a.z};
    }
    constexpr Symmetric3T& operator+=(const Symmetric3T& o) {
        xx += o.xx, yy += o.yy, zz += o.zz, xy += o.xy, xz += o.xz, yz += o.yz;
        return *this;
    }
    constexpr T trace() const { return xx + yy + zz; }
    constexpr Vec3T<T> operator*(const Vec3T<T>& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
    /// The inverse, by cofactors; the matrix must be positive definite.
    Symmetric3T inverse() const {
        const T bc = yy * zz - yz * yz, ef = xz * yz - xy * zz, df = xy * yz - xz * yy;
        const T scale = 1 / (xx * bc + xy * ef + xz * df);
        return {bc * scale, (xx * zz - xz * xz) * scale, (xx * yy - xy * xy) * scale, ef * scale,
                df * scale, (xy * xz - xx * yz) * scale};
    }
    template <typename U> constexpr explicit operator Symmetric3T<U>() const {
        return {U(xx), U(yy), U(zz), U(xy), U(xz), U(yz)};
    }
};
using Symmetric3 = Symmetric3T<float>;
/// Where matrices are inverted: viscosity and the light envelope points make inverse masses that
/// differ by a factor of ten thousand between directions, and the weak direction's digits must
/// survive the strong one's.
using Symmetric3d = Symmetric3T<double>;

/// How a section answers impulses (docs/model.md, "Response of a point to an impulse"): T⁻¹ =
/// across·I + extra·n nᵀ for the skeleton point, 1/m for the motion of an envelope point along its
/// half line. All zero for a kinematic section.
struct SectionMass {
    float across = 0, extra = 0, envelope = 0;
    Vec3 normal;

    static SectionMass of(const HairView& hair, std::uint32_t section) {
        const Slot slot = hair.layout.slot(section);
        return {hair.rest.at(slot, Rest::inverse_mass_across),
                hair.rest.at(slot, Rest::inverse_mass_extra),
                hair.rest.at(slot, Rest::inverse_envelope_mass), hair.frames.normal.vec(slot)};
    }
    Vec3 skeleton_response(const Vec3& impulse) const {
        return impulse * across + normal * (dot(normal, impulse) * extra);
    }
};

/// Direction of half line k of a section, in the world.
inline Vec3 half_line_direction(const HairView& hair, Slot slot, std::uint32_t k) {
    const HalfLine& d = hair.half_lines[k];
    return hair.frames.u.vec(slot) * d.cosine + hair.frames.v.vec(slot) * d.sine;
}

} // namespace mane
