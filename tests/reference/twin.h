#pragma once

/// The reference twin: the whole step of `docs/model.md` in plain scalar double, to be read beside
/// the paper. It shares no code with `src/`, only the public types, and is the page against which
/// the core is judged. One file per section of the paper:
///
///   hair.cpp          from a Groom to the twin's own arrays
///   skeleton.cpp      §3.2  stretching and bending
///   frames.cpp        §3.3  cross-sections and their frames
///   envelope.cpp      §3.3  radial and ring springs, and how they act on the skeleton
///   step.cpp          §5.1  forces, velocities, positions
///   energy.cpp        what the springs store and the motion carries
///   interactions.cpp  §4.1  between wisps
///   character.cpp     §4.2  with the character

#include "mane/frame.h"
#include "mane/groom.h"
#include "mane/vec.h"
#include "reference/matrix.h"

#include <vector>

namespace mane::reference {

/// One number per envelope point of a section.
using Ring = std::vector<double>;

/// One wisp with sections 0 … n, from inside the head to the tip. Sections 0 and 1 are kinematic.
struct Wisp {
    // rest data, named as in Groom; segment i and joint i are stored at i
    double thickness_power = 0;
    std::vector<double> skeleton_mass, envelope_mass;
    std::vector<double> stretch_stiffness, stretch_damping, rest_length;
    std::vector<double> bend_stiffness, bend_damping, rest_curvature_u, rest_curvature_v;
    std::vector<double> radial_stiffness, radial_damping, ring_stiffness, ring_damping;
    std::vector<Ring> rest_radius, ring_length;
    std::vector<Ring> design_radius;

    // state
    std::vector<Vec3d> x, v;     ///< [m], [m/s]
    std::vector<Ring> r, r_rate; ///< [m], [m/s]
    Vec3d u0;                    ///< first axis of section 0, attached to the head
    std::vector<Vec3d> air;      ///< [m/s] velocity of the air at each section

    std::size_t sections() const { return x.size(); }
    std::size_t points() const { return r.front().size(); } ///< K
};

/// The whole head of hair. Positions and radii start as designed, at rest in still air; `u0` has to
/// be set for each wisp.
struct Hair {
    std::vector<Wisp> wisps;
    explicit Hair(const Groom& groom);
};

/// Takes positions, velocities, radii, rates and first axes from a stored frame; positions stay
/// relative to its origin.
void set_state(Hair& hair, const Frame& frame);

/// Where the head holds a wisp: what the kinematic sections are at one time.
struct Root {
    Vec3d x0, x1; ///< [m]
    Vec3d v0, v1; ///< [m/s]
    Vec3d u0;     ///< unit
};

/// What acts on all alike.
struct Surroundings {
    Vec3d gravity = {0, -9.81, 0}; ///< [m/s²]
    double air_drag = 0;           ///< [1/s]
};

// §3.2, skeleton.cpp
/// Forces of the stretching and bending springs on every skeleton point [N]; their sum is zero.
std::vector<Vec3d> skeleton_forces(const Wisp& wisp);
/// Length of segment i, at least 1e-6 m, and its direction: a unit vector, shorter where the
/// segment vanishes.
double segment_length(const Wisp& wisp, std::size_t i);
Vec3d segment_direction(const Wisp& wisp, std::size_t i);
/// The bend at joint i as a vector in the section's axes [rad].
struct Curvature {
    double u = 0, v = 0;
};
Curvature curvature(const Wisp& wisp, std::size_t i);
/// Stiffness of joint i at the present thickness [N·m/rad].
double bend_stiffness(const Wisp& wisp, std::size_t i);

// §3.3, frames.cpp
/// A cross-section's plane: normal toward the tip, and two axes.
struct SectionFrame {
    Vec3d n, u, v;
};
/// The frames of all sections, from the present curve and `u0` alone (M8).
std::vector<SectionFrame> section_frames(const Wisp& wisp);
/// Half line k of K.
Vec3d half_line(const SectionFrame& frame, std::size_t k, std::size_t points);

// §3.3, envelope.cpp
/// Forces of the radial and ring springs along the half lines of section i [N].
Ring envelope_forces(const Wisp& wisp, std::size_t i);
/// Natural response of the radial spring at ratio ρ of its rest length, per k₀ r⁰.
double radial_response(double ratio);
/// Distance between envelope points k and k+1 of section i, at least 1e-6 m.
double ring_distance(const Wisp& wisp, std::size_t i, std::size_t k);

/// Inertia of section i's skeleton point: T = M + Σ m_e (I − d dᵀ). It carries the envelope across
/// the half lines.
Matrix3 section_inertia(const Wisp& wisp, const SectionFrame& frame, std::size_t i);

// §5.1, step.cpp
struct Accelerations {
    std::vector<Vec3d> x; ///< [m/s²] per section
    std::vector<Ring> r;  ///< [m/s²] per section and envelope point
};
/// Accelerations of every simulated section; zero for the kinematic ones.
Accelerations accelerations(const Wisp& wisp, const Surroundings& surroundings);
void set_root_position(Wisp& wisp, const Root& root);
void set_root_velocity(Wisp& wisp, const Root& root);
void integrate_velocities(Wisp& wisp, const Accelerations& a, double h);
void integrate_positions(Wisp& wisp, double h);
/// One step of a wisp that touches nothing.
void step(Wisp& wisp, const Root& start, const Root& end, const Surroundings& surroundings,
          double h);

// energy.cpp
struct Energy {
    double kinetic = 0, stretch = 0, bend = 0, radial = 0, ring = 0, gravity = 0; ///< [J]
    double elastic() const { return stretch + bend + radial + ring; }
    double total() const { return kinetic + elastic() + gravity; }
};
/// Mechanical energy of the simulated sections and of the springs that hold them.
Energy energy(const Wisp& wisp, const Vec3d& gravity);

} // namespace mane::reference
