#pragma once

#include <cmath>
#include <cstddef>

namespace mane {

/// Three numbers: a point, a direction or a velocity. Right-handed, Y up, metres and seconds.
template <typename T> struct Vec3T {
    T x{}, y{}, z{};

    constexpr Vec3T() = default;
    constexpr Vec3T(T x_, T y_, T z_) : x(x_), y(y_), z(z_) {}
    template <typename U> constexpr explicit Vec3T(const Vec3T<U>& o)
        : x(T(o.x)), y(T(o.y)), z(T(o.z)) {}

    constexpr Vec3T operator-() const { return {-x, -y, -z}; }
    constexpr Vec3T& operator+=(const Vec3T& o) { return *this = {x + o.x, y + o.y, z + o.z}; }
    constexpr Vec3T& operator-=(const Vec3T& o) { return *this = {x - o.x, y - o.y, z - o.z}; }
    constexpr Vec3T& operator*=(T s) { return *this = {x * s, y * s, z * s}; }
    constexpr bool operator==(const Vec3T&) const = default;

    friend constexpr Vec3T operator+(Vec3T a, const Vec3T& b) { return a += b; }
    friend constexpr Vec3T operator-(Vec3T a, const Vec3T& b) { return a -= b; }
    friend constexpr Vec3T operator*(Vec3T a, T s) { return a *= s; }
    friend constexpr Vec3T operator*(T s, Vec3T a) { return a *= s; }
    friend constexpr Vec3T operator/(Vec3T a, T s) { return {a.x / s, a.y / s, a.z / s}; }
};

using Vec3 = Vec3T<float>;
using Vec3d = Vec3T<double>;

template <typename T> constexpr T dot(const Vec3T<T>& a, const Vec3T<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <typename T> constexpr Vec3T<T> cross(const Vec3T<T>& a, const Vec3T<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <typename T> T length(const Vec3T<T>& a) {
    return std::sqrt(dot(a, a));
}
/// `a` at length one. A zero vector stays zero, so that a caller can test for it.
template <typename T> Vec3T<T> normalized(const Vec3T<T>& a) {
    const T l = length(a);
    return l > T(0) ? a / l : Vec3T<T>{};
}

/// A rotation as a unit quaternion, scalar part last.
template <typename T> struct QuatT {
    T x{}, y{}, z{}, w{1};

    constexpr bool operator==(const QuatT&) const = default;
    constexpr QuatT conjugate() const { return {-x, -y, -z, w}; }

    /// The rotation `b` followed by the rotation `a`.
    friend constexpr QuatT operator*(const QuatT& a, const QuatT& b) {
        return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
                a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
    }
    constexpr Vec3T<T> rotate(const Vec3T<T>& v) const {
        const Vec3T<T> q{x, y, z};
        const Vec3T<T> t = cross(q, v) * T(2);
        return v + t * w + cross(q, t);
    }
};

using Quat = QuatT<float>;
using Quatd = QuatT<double>;

template <typename T> constexpr T dot(const QuatT<T>& a, const QuatT<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
}
template <typename T> QuatT<T> normalized(const QuatT<T>& q) {
    const T l = std::sqrt(dot(q, q));
    return {q.x / l, q.y / l, q.z / l, q.w / l};
}

} // namespace mane
