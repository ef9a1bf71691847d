#pragma once

#include "groom/shape.h"
#include "mane/style.h"

#include <vector>

namespace mane {

/// Earth's, whatever the scene's: the physical parameters are defined by it, so that a scene on the
/// moon has the same hair.
inline constexpr double kStandardGravity = 9.81; // [m/s²]

/// One wisp's masses and springs, as docs/model.md's "Masses", "Stretch", "Bending stiffness" and
/// "Radial spring" define them. What depends on rest lengths (bending per joint) is made with them
/// in `rest.h`.
struct Material {
    std::vector<double> section_mass;  ///< [kg] all of a section
    std::vector<double> skeleton_mass; ///< [kg] of the skeleton point
    std::vector<double> envelope_mass; ///< [kg] of each envelope point
    double stretch_stiffness = 0;      ///< [N] EA
    double stretch_damping = 0;        ///< [N·s/m]
    std::vector<double> bend_rigidity; ///< [N·m²] EI per section
    double bend_time = 0;              ///< [s] τ: damping over stiffness of every joint
    std::vector<double> radial_stiffness, radial_damping; ///< [N/m], [N·s/m] per section
    std::vector<double> ring_stiffness, ring_damping;     ///< [N/m], [N·s/m] per section
};

Material make_material(const WispDesign& wisp, const Shape& shape);

/// The mean of a section's radii [m].
double mean_radius(const WispDesign& wisp, std::size_t section);

} // namespace mane
