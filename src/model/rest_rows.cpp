#include "model/rest_rows.h"

#include <algorithm>

namespace mane {
namespace {

/// [m] that a natural radius has at least, padding included: a spring's force has its square over
/// the radius now.
constexpr float kLeastRadius = 1e-8f;

} // namespace

RestRows::RestRows(const Groom& groom, const Layout& layout)
    : rows_(layout.rows(), kColumns + 2 * groom.envelope_points),
      thickness_power_(layout.packets().size(), 1) {
    const std::uint32_t k = groom.envelope_points;
    for (std::size_t r = 0; r < layout.rows(); ++r)
        std::fill_n(rows_.row(r) + kColumns * kLanes, k * kLanes, kLeastRadius);
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        const std::uint32_t first = groom.first_section[w], sections = groom.sections(w);
        for (std::uint32_t i = 0; i < sections; ++i) {
            const std::uint32_t s = first + i;
            const Slot slot = layout.slot(s);
            const auto set = [&](Rest column, double value) { this->set(slot, column, value); };

            const bool has_segment = i + 1 < sections, has_joint = i >= 1 && has_segment;
            if (has_segment)
                set(Rest::length, double{groom.rest_length[s]});
            if (has_joint) { // segment 0 is rigid, and joint i bends between segments i−1 and i
                set(Rest::stretch, double{groom.stretch_stiffness[s] / groom.rest_length[s]});
                set(Rest::stretch_damping, double{groom.stretch_damping[s]});
                set(Rest::bend, double{groom.bend_stiffness[s]});
                set(Rest::bend_damping, double{groom.bend_damping[s]});
                set(Rest::curvature_u, double{groom.rest_curvature_u[s]});
                set(Rest::curvature_v, double{groom.rest_curvature_v[s]});
            }
            double radii = 0;
            for (std::uint32_t e = 0; e < k; ++e)
                radii += groom.radius[s * k + e];
            set(Rest::inverse_radius_sum, 1 / radii);

            if (layout.simulated(s)) {
                release(slot, groom, s);
                set(Rest::inverse_envelope_mass, 1 / double{groom.envelope_mass[s]});
                set(Rest::half_radial, double{groom.radial_stiffness[s]} / 2);
                set(Rest::radial_damping, double{groom.radial_damping[s]});
                set(Rest::ring, double{groom.ring_stiffness[s]});
                set(Rest::ring_damping, double{groom.ring_damping[s]});
            }
            for (std::uint32_t e = 0; e < k; ++e) {
                rows_.at(slot, kColumns + e) = std::max(groom.rest_radius[s * k + e], kLeastRadius);
                rows_.at(slot, kColumns + k + e) =
                    groom.ring_stiffness[s] * groom.ring_length[s * k + e];
            }
        }
    }
    for (std::size_t p = 0; p < layout.packets().size(); ++p) {
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
            const std::uint32_t w = layout.packets()[p].wisp[lane];
            const float power = w == Layout::kNoWisp ? 2.f : groom.thickness_power[w];
            thickness_power_.row(p)[lane] = power;
            square_thickness_ = square_thickness_ && power == 2.f;
        }
    }
}

void RestRows::hold(Slot slot) {
    set(slot, Rest::inverse_mass_across, 0);
    set(slot, Rest::inverse_mass_extra, 0);
}

void RestRows::release(Slot slot, const Groom& groom, std::uint32_t section) {
    const double k = groom.envelope_points, m = groom.envelope_mass[section];
    const double across = groom.skeleton_mass[section] + m * k / 2,
                 along = groom.skeleton_mass[section] + m * k;
    set(slot, Rest::inverse_mass_across, 1 / across);
    set(slot, Rest::inverse_mass_extra, 1 / along - 1 / across);
}

} // namespace mane
