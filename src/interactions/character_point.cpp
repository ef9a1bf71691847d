#include "interactions/character_point.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

/// A point's two sections with their weights; the second one counts only where the point is between
/// sections.
struct Shares {
    std::array<std::uint32_t, 2> section;
    std::array<float, 2> weight;
    int count;
};
Shares shares(const WispPoint& p) {
    return {{p.section, p.section + 1}, {1 - p.along, p.along}, p.along > 0 ? 2 : 1};
}

} // namespace

Slot WispCopy::slot(const HairView& hair, std::uint32_t section) const {
    return hair.layout.slot(hair.groom.first_section[number_] + section);
}

void WispCopy::load(const HairView& hair, std::uint32_t number) {
    load_motion(hair, number, 0, static_cast<std::uint32_t>(hair.groom.sections(number)));
    load_masses(hair);
}

void WispCopy::load_motion(const HairView& hair, std::uint32_t number, std::uint32_t first,
                           std::uint32_t end) {
    number_ = number;
    first_ = first;
    end_ = end;
    lines_ = hair.half_lines;
    const std::size_t n = hair.groom.sections(number);
    x.resize(n);
    v.resize(n);
    directions.resize(n * k());
    radius.resize(n * k());
    radius_rate.resize(n * k());
    for (std::uint32_t i = first; i < end; ++i) {
        const Slot here = slot(hair, i);
        x[i] = hair.state.position.vec(here);
        v[i] = hair.state.velocity.vec(here);
        for (std::uint32_t line = 0; line < k(); ++line) {
            directions[i * k() + line] = half_line_direction(hair, here, line);
            r(i, line) = hair.state.radius.at(here, line);
            rate(i, line) = hair.state.radius_rate.at(here, line);
        }
    }
}

void WispCopy::load_masses(const HairView& hair) {
    mass_.resize(x.size());
    for (std::uint32_t i = first_; i < end_; ++i)
        mass_[i] = SectionMass::of(hair, hair.groom.first_section[number_] + i);
}

void WispCopy::store_velocities(const HairView& hair, State& state) const {
    for (std::uint32_t i = std::max(first_, 2u); i < end_; ++i) {
        const Slot here = slot(hair, i);
        state.velocity.set(here, v[i]);
        for (std::uint32_t line = 0; line < k(); ++line)
            state.radius_rate.at(here, line) = rate(i, line);
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

// α = β on α² + β² + 2αβC = 1.
WispPoint WispCopy::half_arc(std::uint32_t section, std::uint32_t line) const {
    const float c = dot(d(section, line), d(section, next(line)));
    const float share = 1 / std::sqrt(2 + 2 * c);
    return {section, 0, line, share, share};
}

Vec3 WispCopy::halfway(std::uint32_t i, const WispPoint& place) const {
    const auto at = [&](std::uint32_t section) {
        WispPoint p = place;
        p.section = std::min(section, sections() - 1);
        return position(p);
    };
    return (at(i - 1) + at(i)) * (9.0f / 16) - (at(i - 2) + at(i + 1)) * (1.0f / 16);
}

float WispCopy::inverse_mass(const WispPoint& p, const Vec3& e) const {
    float sum = 0;
    const Shares share = shares(p);
    for (int j = 0; j < share.count; ++j) {
        const std::uint32_t s = share.section[j];
        if (!answers(s))
            continue;
        Vec3 rest = e;
        float envelope = 0;
        if (!p.on_axis()) {
            const Vec3 d0 = d(s, p.k), d1 = d(s, next(p.k));
            const float e0 = p.alpha * dot(d0, e), e1 = p.beta * dot(d1, e);
            rest = e - d0 * e0 - d1 * e1;
            envelope = (e0 * e0 + e1 * e1) * mass_[s].envelope;
        }
        sum += share.weight[j] * share.weight[j] *
               (dot(rest, mass_[s].skeleton_response(rest)) + envelope);
    }
    return sum;
}

// The generalised coordinates are the skeleton's velocity ẋ and q = ṙ + ẋ·d of every envelope
// point; the kinetic energy is diagonal in them (docs/model.md). The point's velocity is (I − α d
// dᵀ − β d'd'ᵀ) ẋ + α d q + β d'q', so an impulse J gives q its part along the half lines and ẋ the
// rest; a q that is not pushed stays, so ṙ takes up the skeleton's change.
void WispCopy::push(const WispPoint& p, const Vec3& impulse) {
    const Shares share = shares(p);
    for (int j = 0; j < share.count; ++j) {
        const std::uint32_t s = share.section[j];
        if (!answers(s))
            continue;
        Vec3 rest = impulse * share.weight[j];
        if (!p.on_axis()) {
            const std::uint32_t l0 = p.k, l1 = next(p.k);
            const Vec3 d0 = d(s, l0), d1 = d(s, l1);
            const float q0 = p.alpha * dot(d0, rest), q1 = p.beta * dot(d1, rest);
            rate(s, l0) += q0 * mass_[s].envelope;
            rate(s, l1) += q1 * mass_[s].envelope;
            rest = rest - d0 * q0 - d1 * q1;
        }
        const Vec3 change = mass_[s].skeleton_response(rest);
        v[s] += change;
        for (std::uint32_t line = 0; line < k(); ++line)
            rate(s, line) -= dot(d(s, line), change);
    }
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
