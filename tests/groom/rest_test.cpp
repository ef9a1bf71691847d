#include "designs.h"
#include "groom/balance.h"
#include "mane/error.h"

#include <doctest/doctest.h>

using namespace mane;
using namespace mane::test;

namespace {

// The energy that bending stores in a curve: frames and all, nothing of the forces' closed forms.
double bending_energy(const Balance& b, const std::vector<Vec3d>& position) {
    const Shape s = make_shape(position, b.shape.u[0]);
    double sum = 0;
    for (std::size_t i = 1; i < s.segments(); ++i) {
        const Vec3d a = s.tangent[i - 1], t = s.tangent[i], w = t - a;
        const double theta = std::atan2(length(cross(a, t)), dot(a, t));
        const Vec3d kappa = length(w) > 0 ? normalized(w) * theta : Vec3d{};
        const double u = dot(kappa, s.u[i]) - b.rest.curvature_u[i],
                     v = dot(kappa, s.v[i]) - b.rest.curvature_v[i];
        sum += b.rest.bend_stiffness[i] * (u * u + v * v) / 2;
    }
    return sum;
}

double& component(Vec3d& v, std::size_t axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// Minus the slope of that energy, by differences of the fourth order.
Vec3d bending_force(const Balance& b, std::size_t section) {
    std::vector<Vec3d> moved = b.shape.position;
    const double h = 1e-4 * b.shape.length[1];
    Vec3d force;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto energy_at = [&](double way) {
            moved[section] = b.shape.position[section];
            component(moved[section], axis) += way;
            return bending_energy(b, moved);
        };
        const double near = energy_at(-h) - energy_at(h),
                     far = energy_at(-2 * h) - energy_at(2 * h);
        component(force, axis) = (8 * near - far) / (12 * h);
    }
    return force;
}

// Springs of docs/model.md written again, on the simulated sections.
std::vector<Vec3d> spring_forces(const Balance& b) {
    const Shape& s = b.shape;
    std::vector<Vec3d> force(s.sections());
    for (std::size_t i = 1; i < s.segments(); ++i) {
        const double f = b.material.stretch_stiffness * (s.length[i] / b.rest.length[i] - 1);
        force[i] += s.tangent[i] * f;
        force[i + 1] -= s.tangent[i] * f;
    }
    for (std::size_t i = 2; i < s.sections(); ++i)
        force[i] += bending_force(b, i);
    return force;
}

Vec3d half_line(const Balance& b, std::size_t i, std::size_t k, std::size_t points) {
    const double angle = 2 * 3.14159265358979323846 * double(k) / double(points);
    return b.shape.u[i] * std::cos(angle) + b.shape.v[i] * std::sin(angle);
}

// Accelerations over g of every degree of freedom at rest (docs/model.md, "Coupling"): the largest
// of all.
double worst_acceleration(const WispDesign& d, const Balance& b, const Vec3d& gravity) {
    const std::size_t points = d.envelope.points;
    const double g = length(gravity);
    std::vector<Vec3d> force = spring_forces(b);
    double worst = 0;
    for (std::size_t i = 2; i < b.shape.sections(); ++i) {
        std::vector<double> radial(points);
        Vec3d reaction;
        for (std::size_t k = 0; k < points; ++k) {
            const double r = d.radius[i * points + k], rest = b.rest.radius[i * points + k];
            radial[k] = 0.5 * b.material.radial_stiffness[i] * rest * (rest / r - r / rest);
            reaction -= half_line(b, i, k, points) * radial[k];
        }
        // T is diagonal in (n, u, v).
        const double all = b.material.section_mass[i];
        const double across =
            b.material.skeleton_mass[i] + double(points) / 2 * b.material.envelope_mass[i];
        const Vec3d total = force[i] + reaction, n = b.shape.normal[i];
        const Vec3d a = n * (dot(total, n) / all) + (total - n * dot(total, n)) / across;
        worst = std::max(worst, length(a + gravity) / g);
        for (std::size_t k = 0; k < points; ++k) {
            const double rate =
                radial[k] / b.material.envelope_mass[i] - dot(half_line(b, i, k, points), a);
            worst = std::max(worst, std::fabs(rate) / g);
        }
    }
    return worst;
}

} // namespace

TEST_CASE("in the designed shape the springs alone balance gravity") {
    const Body peg = make_peg();
    const Vec3d down{0, -9.81, 0}, slanted{3, -7, 2};
    StraightWisp sideways = hanging(), steep = hanging(20);
    sideways.direction = {1, 0, 0.2f};
    steep.direction = {-0.3f, -1, 0.1f};
    for (std::uint32_t points : {3u, 4u, 6u}) {
        sideways.envelope.points = steep.envelope.points = points;
        for (const WispDesign& d :
             {design(sideways, peg.mesh), design(steep, peg.mesh), curled(12, points)})
            for (const Vec3d& gravity : {down, slanted})
                // Bending energies of 1e-4 J differenced over 4e-6 m: rounding leaves 1e-14 N of a
                // section's weight of 1e-5 N and more.
                CHECK(worst_acceleration(d, balance(d, gravity), gravity) < 1e-8);
    }
}

TEST_CASE("without gravity the rest shape is the design") {
    const WispDesign d = curled();
    const Balance b = balance(d, {});
    for (std::size_t i = 1; i < b.shape.segments(); ++i) {
        CHECK(b.rest.length[i] == b.shape.length[i]);
        const double bend = std::acos(dot(b.shape.tangent[i - 1], b.shape.tangent[i]));
        CHECK(std::hypot(b.rest.curvature_u[i], b.rest.curvature_v[i]) ==
              doctest::Approx(bend).epsilon(1e-7));
    }
    for (std::size_t j = 0; j < d.radius.size(); ++j)
        CHECK(b.rest.radius[j] == doctest::Approx(double{d.radius[j]}));
}

TEST_CASE("an upright wisp buckles under its weight at Γ = 7.837, and the stiffness that would do "
          "is said") {
    // Greenhill: Γ = λ g S³ / EI, and EI = λ g b³, so that b = S / 7.837^⅓ is the least that
    // stands.
    const Body peg = make_peg();
    StraightWisp wisp = hanging(32);
    wisp.triangle = 0;
    wisp.direction = {0, 1, 0};
    wisp.radius = 0.01f;
    wisp.skeleton.strain = 1e-4f;
    Body upside_down = peg;
    for (Vec3& v : upside_down.mesh.vertices)
        v = {v.x, -v.y, -v.z}; // triangle 0 looks up
    const double critical = double{wisp.length} / std::cbrt(7.837);

    wisp.skeleton.bending_length = float(0.98 * critical);
    const WispDesign soft = design(wisp, upside_down.mesh);
    const Balance b = balance(soft);
    CHECK_FALSE(is_stable(b.shape, b.material, b.rest));
    // Joints in place of a rod: the error falls with the square of the segment's length, 0.1 %
    // at 32.
    CHECK(standing_bending_length(soft, {0, -9.81, 0}) == doctest::Approx(critical).epsilon(0.003));
    CHECK_THROWS_WITH_AS(
        make_groom(std::vector{soft}, upside_down.mesh),
        doctest::Contains("wisp 0: its weight would make it fall out of the designed shape: "
                          "skeleton.bending_length is 0.19"),
        InputError);

    wisp.skeleton.bending_length = float(1.02 * critical);
    CHECK_NOTHROW(make_groom(std::vector{design(wisp, upside_down.mesh)}, upside_down.mesh));
}

TEST_CASE("the forces judged for stability are those of the balance") {
    const Balance b = balance(curled());
    const std::vector<Vec3d> mine = spring_forces(b),
                             judged = skeleton_forces(b.shape, b.material, b.rest);
    for (std::size_t i = 2; i < mine.size(); ++i)
        CHECK(length(mine[i] - judged[i]) < 1e-10 * b.material.stretch_stiffness);
}
