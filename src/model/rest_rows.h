#pragma once

#include "model/layout.h"

namespace mane {

/// Columns of `RestRows`, one number per section. Zero everywhere that a lane has no such segment,
/// joint or point, which makes padding inert without masks.
enum class Rest : std::uint32_t {
    length,  ///< L of the segment after the section
    stretch, ///< EA/L
    stretch_damping,
    bend, ///< k without the factor of thickness
    bend_damping,
    curvature_u,
    curvature_v,
    inverse_radius_sum,  ///< 1 / Σ designed radii: for the factor of thickness
    inverse_mass_across, ///< 1/T in the section's plane, 0 where kinematic
    inverse_mass_extra,  ///< 1/T along the normal minus the above
    inverse_envelope_mass,
    half_radial, ///< half the stiffness of the radial springs
    radial_damping,
    ring,
    ring_damping,
    count
};

/// All that the forces need of the groom, in packet order: read every step, written once. After the
/// `Rest` columns come K natural radii, and for each ring spring its stiffness times its natural
/// length.
class RestRows {
  public:
    RestRows() = default;
    RestRows(const Groom& groom, const Layout& layout);

    static constexpr std::uint32_t kColumns = static_cast<std::uint32_t>(Rest::count);
    std::uint32_t components() const { return rows_.components(); }
    const float* row(std::size_t r) const { return rows_.row(r); }
    float at(Slot slot, Rest column) const {
        return rows_.at(slot, static_cast<std::uint32_t>(column));
    }

    /// Takes a simulated section's skeleton point out of the play of forces, or back in: whatever
    /// acts on it, it does not answer. Its envelope still does.
    void hold(Slot slot);
    void release(Slot slot, const Groom& groom, std::uint32_t section);

    /// M3's power p per packet lane, and whether it is 2 for every wisp (the common case needs no
    /// power function).
    const Rows& thickness_power() const { return thickness_power_; }
    bool square_thickness() const { return square_thickness_; }

  private:
    void set(Slot slot, Rest column, double value) {
        rows_.at(slot, static_cast<std::uint32_t>(column)) = static_cast<float>(value);
    }

    Rows rows_;
    Rows thickness_power_; ///< one row per packet
    bool square_thickness_ = true;
};

} // namespace mane
