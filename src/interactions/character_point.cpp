#include "interactions/character_point.h"

#include <algorithm>
#include <cmath>

namespace mane {

Slot WispCopy::slot(const HairView& hair, std::uint32_t section) const {
    return hair.layout.slot(hair.groom.first_section[number_] + section);
}

void WispCopy::load(const HairView& hair, std::uint32_t number) {
    number_ = number;
    lines_ = hair.half_lines;
    const auto n = static_cast<std::uint32_t>(hair.groom.sections(number));
    x.resize(n);
    v.resize(n);
    directions.resize(n * k());
    radius.resize(n * k());
    radius_rate.resize(n * k());
    answers_.resize(n);
    // α = β on α² + β² + 2αβC = 1, where C is the same for all neighbouring half lines
    const float c = lines_[0].cosine * lines_[1].cosine + lines_[0].sine * lines_[1].sine;
    half_arc_ = 1 / std::sqrt(2 + 2 * c);
    for (std::uint32_t i = 0; i < n; ++i) {
        const Slot here = slot(hair, i);
        x[i] = hair.state.position.vec(here);
        v[i] = hair.state.velocity.vec(here);
        answers_[i] = hair.rest.at(here, Rest::inverse_mass_across) > 0;
        const Vec3 first = hair.frames.u.vec(here), second = hair.frames.v.vec(here);
        for (std::uint32_t line = 0; line < k(); ++line) {
            directions[i * k() + line] = first * lines_[line].cosine + second * lines_[line].sine;
            r(i, line) = hair.state.radius.at(here, line);
            rate(i, line) = hair.state.radius_rate.at(here, line);
        }
    }
}

void WispCopy::store_place(const HairView& hair, std::uint32_t section, State& state) const {
    const Slot here = slot(hair, section);
    state.position.set(here, x[section]);
    for (std::uint32_t line = 0; line < k(); ++line)
        state.radius.at(here, line) = r(section, line);
}

float WispCopy::largest_radius(std::uint32_t section) const {
    const float* first = radius.data() + section * k();
    return *std::max_element(first, first + k());
}

Vec3 WispCopy::halfway(std::uint32_t i, const WispPoint& place) const {
    const auto at = [&](std::uint32_t section) {
        WispPoint p = place;
        p.section = std::min(section, sections() - 1);
        return position(p);
    };
    return (at(i - 1) + at(i)) * (9.0f / 16) - (at(i - 2) + at(i + 1)) * (1.0f / 16);
}

// In a sector the surface is α² + β² + 2αβC = 1 (M14a). The farthest point along g has its gradient
// there: α ∝ A − C B, β ∝ B − C A with A, B the reach of the two half lines along g. It is in the
// sector where both are positive.
WispPoint support_point(const WispCopy& wisp, std::uint32_t section, float along, const Vec3& g) {
    // How far half line k reaches along g.
    const auto reach = [&](std::uint32_t line) {
        const auto of = [&](std::uint32_t s) { return wisp.r(s, line) * dot(wisp.d(s, line), g); };
        return along == 0 ? of(section) : of(section) * (1 - along) + of(section + 1) * along;
    };
    WispPoint best{section, along, 0, 0, 0};
    float farthest = 0;
    for (std::uint32_t line = 0; line < wisp.k(); ++line) {
        const std::uint32_t other = wisp.next(line);
        const float c = dot(wisp.d(section, line), wisp.d(section, other));
        const float a = reach(line), b = reach(other);
        const float alpha = a - c * b, beta = b - c * a;
        if (alpha <= 0 || beta <= 0)
            continue;
        const float size = std::sqrt(alpha * alpha + beta * beta + 2 * c * alpha * beta);
        const float way = (alpha * a + beta * b) / size;
        if (way > farthest) {
            farthest = way;
            best = {section, along, line, alpha / size, beta / size};
        }
    }
    return best;
}

} // namespace mane
