#include "model/section_frames.h"

#include <algorithm>

namespace mane {
namespace {

template <typename T> Vec3T<T> direction(const Vec3T<T>& from, const Vec3T<T>& to) {
    const Vec3T<T> e = to - from;
    return e / std::max(length(e), T(1e-6));
}

template <typename T> Vec3T<T> bisecting_normal(const Vec3T<T>& before, const Vec3T<T>& after) {
    const Vec3T<T> sum = before + after;
    const T l = length(sum);
    return l < T(1e-3) ? before : sum / l; // folded back on itself: no plane bisects
}

template <typename T> Vec3T<T> across(const Vec3T<T>& u, const Vec3T<T>& normal) {
    return normalized(u - normal * dot(u, normal));
}

// The least rotation that takes `from` to `to`, applied to `u`, which is normal to `from`.
template <typename T>
Vec3T<T> carried(const Vec3T<T>& u, const Vec3T<T>& from, const Vec3T<T>& to) {
    const T denominator = std::max(T(1) + dot(from, to), T(1e-6));
    return u - (from + to) * (dot(u, to) / denominator);
}

} // namespace

template <typename T> void section_frames(std::span<const Vec3T<T>> position,
                                          const Vec3T<T>& first_axis,
                                          std::span<SectionFrame<T>> frames) {
    const std::size_t last = position.size() - 1;
    Vec3T<T> tangent = direction(position[0], position[1]);
    Vec3T<T> normal = tangent;
    Vec3T<T> u = across(first_axis, normal);
    frames[0] = {u, cross(normal, u), normal};
    for (std::size_t i = 1; i <= last; ++i) {
        const Vec3T<T> next = i < last ? direction(position[i], position[i + 1]) : tangent;
        const Vec3T<T> n = bisecting_normal(tangent, next);
        u = across(carried(u, normal, n), n);
        frames[i] = {u, cross(n, u), n};
        normal = n;
        tangent = next;
    }
}

template void section_frames(std::span<const Vec3>, const Vec3&, std::span<SectionFrame<float>>);
template void section_frames(std::span<const Vec3d>, const Vec3d&, std::span<SectionFrame<double>>);

} // namespace mane
