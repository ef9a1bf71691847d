#pragma once

#include "mane/groom.h"
#include "reference/twin.h"

#include <cstdint>

namespace mane::reference {

/// One straight wisp of equal segments whose springs are all at rest: the wisp of the closed forms.
struct SingleWisp {
    std::uint32_t segments = 8;    ///< simulated
    std::uint32_t points = 4;      ///< K
    double length = 0.4;           ///< [m] simulated
    Vec3d direction = {0, -1, 0};  ///< unit, from x₀ to the tip
    Vec3d across = {1, 0, 0};      ///< unit, first axis of every section
    double radius = 0.015;         ///< [m]
    double mass_per_length = 5e-3; ///< [kg/m]
    double gravity = 9.81;         ///< [m/s²] that the stiffnesses are measured in
    double strain = 0.005;         ///< [1] of the root segment under its own weight
    double stretch_damping = 0;    ///< [1] damping ratio
    double bending_length = 0.06;  ///< [m] 0: no resistance to bending
    double bending_damping = 0;    ///< [1] damping ratio
    double thickness_power = 0;
    double mass_share = 0.2;     ///< [1] of the section, carried by its envelope
    double squeeze = 0.2;        ///< [1]
    double tip_stiffness = 1;    ///< [1] radial stiffness at the tip over that at the root
    double radial_damping = 1;   ///< [1] damping ratio
    double ring_stiffness = 0.3; ///< [1] relative to the radial springs
    double ring_damping = 2;     ///< [1] damping ratio

    Groom groom() const;
    /// The same as a twin's wisp, held still at the origin (section 1).
    Wisp wisp() const;
};

/// A root that holds the wisp where it is.
Root still_root(const Wisp& wisp);

/// Lets the wisp come to rest in viscous air and returns it: `seconds` of steps of length `h`.
Wisp settled(Wisp wisp, const Surroundings& surroundings, double h, double seconds);

} // namespace mane::reference
