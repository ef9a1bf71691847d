#include "check/finite.h"

#include <algorithm>
#include <cmath>

namespace mane::judge {
namespace {

bool finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

std::optional<std::size_t> first_bad_section(const Groom& groom, const Frame& frame) {
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        if (!finite(frame.first_axis[w]))
            return groom.first_section[w];
        for (std::size_t s = groom.first_section[w]; s < groom.first_section[w + 1]; ++s) {
            bool good = finite(frame.position[s]) && finite(frame.velocity[s]);
            for (std::size_t i = s * groom.envelope_points; i < (s + 1) * groom.envelope_points;
                 ++i)
                good = good && std::isfinite(frame.radius[i]) && frame.radius[i] >= 0 &&
                       std::isfinite(frame.radius_rate[i]);
            if (!good)
                return s;
        }
    }
    return std::nullopt;
}

bool all_finite(const std::vector<std::vector<Vec3>>& vertices) {
    return std::ranges::all_of(
        vertices, [](const std::vector<Vec3>& body) { return std::ranges::all_of(body, finite); });
}

} // namespace mane::judge
