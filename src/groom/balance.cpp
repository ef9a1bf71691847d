#include "groom/balance.h"

#include "groom/joint.h"
#include "groom/matrix.h"

#include <cmath>

namespace mane {
namespace {

void add_stretch(std::vector<Vec3d>& force, const Shape& s, const Material& m, const Rest& rest) {
    for (std::size_t i = 1; i < s.segments(); ++i) {
        const Vec3d pull =
            s.tangent[i] * (m.stretch_stiffness * (s.length[i] / rest.length[i] - 1));
        force[i] += pull;
        force[i + 1] -= pull;
    }
}

// A moment against a segment's turning is a couple of forces at its two ends.
void add_couple(std::vector<Vec3d>& force, const Shape& s, std::size_t segment,
                const Vec3d& moment) {
    const Vec3d f = cross(moment, s.tangent[segment]) / s.length[segment];
    force[segment + 1] -= f;
    force[segment] += f;
}

void add_bending(std::vector<Vec3d>& force, const Shape& s, const Rest& rest) {
    double twist = 0;
    for (std::size_t i = s.segments() - 1; i >= 1; --i) {
        const Joint joint(s, i);
        const Vec3d off_rest =
            joint.off_rest(rest.curvature_u[i], rest.curvature_v[i]) * rest.bend_stiffness[i];
        add_couple(force, s, i, joint.on_after(off_rest) + joint.handed_on_after(twist));
        add_couple(force, s, i - 1, joint.on_before(off_rest) + joint.handed_on_before(twist));
        twist += joint.twist(off_rest);
    }
}

double& component(Vec3d& v, std::size_t axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

// −∂F/∂x over the simulated sections, by central differences. Differences and not a formula: every
// frame turns with all of the curve before it, and the forces themselves, which the step uses, are
// what has to be judged.
Matrix tangent_stiffness(const Shape& shape, const Material& material, const Rest& rest) {
    const std::size_t n = shape.sections() - 2;
    Matrix stiffness(3 * n);
    std::vector<Vec3d> moved = shape.position;
    for (std::size_t column = 0; column < 3 * n; ++column) {
        double& x = component(moved[2 + column / 3], column % 3);
        const double home = x, step = 1e-6 * shape.length[1 + column / 3];
        const auto forces_at = [&](double value) {
            x = value;
            return skeleton_forces(make_shape(moved, shape.u[0]), material, rest);
        };
        std::vector<Vec3d> ahead = forces_at(home + step), behind = forces_at(home - step);
        x = home;
        for (std::size_t row = 0; row < 3 * n; ++row)
            stiffness.at(row, column) =
                (component(behind[2 + row / 3], row % 3) - component(ahead[2 + row / 3], row % 3)) /
                (2 * step);
    }
    return stiffness;
}

void make_symmetric(Matrix& m) {
    for (std::size_t i = 0; i < m.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            m.at(i, j) = m.at(j, i) = (m.at(i, j) + m.at(j, i)) / 2;
}

} // namespace

std::vector<Vec3d> skeleton_forces(const Shape& shape, const Material& material, const Rest& rest) {
    std::vector<Vec3d> force(shape.sections());
    add_stretch(force, shape, material, rest);
    add_bending(force, shape, rest);
    return force;
}

bool is_stable(const Shape& shape, const Material& material, const Rest& rest) {
    Matrix stiffness = tangent_stiffness(shape, material, rest);
    make_symmetric(stiffness);
    return is_positive_definite(stiffness, stiffness.size());
}

double standing_bending_length(const WispDesign& wisp, const Vec3d& gravity) {
    const std::vector<Vec3d> position(wisp.position.begin(), wisp.position.end());
    const Shape shape = make_shape(position, Vec3d(wisp.first_axis));
    WispDesign tried = wisp;
    const auto stands = [&](double bending_length) {
        tried.skeleton.bending_length = static_cast<float>(bending_length);
        const Material material = make_material(tried, shape);
        return is_stable(shape, material, make_rest(tried, shape, material, gravity));
    };
    const double own = wisp.skeleton.bending_length;
    if (stands(own))
        return own;
    double low = own, high = 2 * own;
    for (; !stands(high); high *= 2)
        if (high > 32 * own)
            return 0;
    while (high - low > 1e-3 * high) {
        const double middle = (low + high) / 2;
        (stands(middle) ? high : low) = middle;
    }
    return high;
}

double largest_droop(const WispDesign& wisp, const Vec3d& gravity) {
    const std::vector<Vec3d> position(wisp.position.begin(), wisp.position.end());
    const Shape shape = make_shape(position, Vec3d(wisp.first_axis));
    const Rest rest = make_rest(wisp, shape, make_material(wisp, shape), gravity);
    double largest = 0;
    for (std::size_t i = 1; i < shape.segments(); ++i)
        largest = std::fmax(
            largest, length(Joint(shape, i).off_rest(rest.curvature_u[i], rest.curvature_v[i])));
    return largest;
}

} // namespace mane
