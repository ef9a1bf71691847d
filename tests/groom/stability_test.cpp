#include "designs.h"
#include "groom/stability.h"
#include "mane/error.h"

#include <doctest/doctest.h>

#include <string>

using namespace mane;
using namespace mane::test;

namespace {

// docs/model.md's step for a straight wisp along z, K = 4, in double: small motions around the
// state that the bound is for, where every radius is ρ of its rest and every joint's stiffness has
// the factor `thickness`.
class Straight {
  public:
    Straight(const Groom& g, double drag, double rho, double thickness)
        : g_(g), drag_(drag), rho_(rho), thickness_(thickness), n_(g.sections(0)), x_(n_), v_(n_),
          r_(4 * n_), dr_(4 * n_) {
        for (std::size_t i = 2; i < n_; ++i) {
            const double s = double(i) * 1.7;
            x_[i] = Vec3d{std::sin(s), std::cos(3 * s), std::sin(2 * s + 1)} * 1e-9;
            for (std::size_t k = 0; k < 4; ++k)
                r_[4 * i + k] = 1e-9 * std::cos(5 * s + double(k * k));
        }
    }

    void step(double h) {
        std::vector<Vec3d> force(n_);
        stretch(force);
        bend(force);
        std::vector<Vec3d> a(n_);
        std::vector<double> rr(4 * n_);
        for (std::size_t i = 2; i < n_; ++i)
            section(i, force[i], a[i], &rr[4 * i]);
        for (std::size_t i = 2; i < n_; ++i) {
            v_[i] += a[i] * h;
            x_[i] += v_[i] * h;
            for (std::size_t j = 4 * i; j < 4 * i + 4; ++j)
                r_[j] += h * (dr_[j] += h * rr[j]);
        }
    }
    double size() const {
        double sum = 0;
        for (const Vec3d& x : x_)
            sum += dot(x, x);
        for (double r : r_)
            sum += r * r;
        return std::sqrt(sum);
    }

  private:
    void stretch(std::vector<Vec3d>& force) const {
        for (std::size_t i = 1; i + 1 < n_; ++i) {
            const double f =
                double{g_.stretch_stiffness[i]} / g_.rest_length[i] * (x_[i + 1].z - x_[i].z) +
                double{g_.stretch_damping[i]} * (v_[i + 1].z - v_[i].z);
            force[i].z += f;
            force[i + 1].z -= f;
        }
    }
    void bend(std::vector<Vec3d>& force) const {
        for (std::size_t i = 1; i + 1 < n_; ++i) {
            const double a = g_.rest_length[i - 1], b = g_.rest_length[i];
            const auto curvature = [&](const std::vector<Vec3d>& p) {
                const Vec3d c = (p[i + 1] - p[i]) / b - (p[i] - p[i - 1]) / a;
                return Vec3d{c.x, c.y, 0};
            };
            const Vec3d m = curvature(x_) * (thickness_ * g_.bend_stiffness[i]) +
                            curvature(v_) * double{g_.bend_damping[i]};
            force[i + 1] -= m / b;
            force[i] += m / b + m / a;
            force[i - 1] -= m / a;
        }
    }
    void section(std::size_t i, const Vec3d& force, Vec3d& a, double* rr) const {
        const Vec3d d[4] = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
        double q[4];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t j = 4 * i + k, next = 4 * i + (k + 1) % 4, last = 4 * i + (k + 3) % 4;
            // Equal radii: d = √2 r, so that a ring spring sees (ṙ_k + ṙ_{k+1})/√2 and pulls by
            // 1/√2 on each.
            q[k] = -0.5 * double{g_.radial_stiffness[i]} * (1 / (rho_ * rho_) + 1) * r_[j] -
                   double{g_.radial_damping[i]} * dr_[j] -
                   double{g_.ring_stiffness[i]} / 2 * (2 * r_[j] + r_[next] + r_[last]) -
                   double{g_.ring_damping[i]} / 2 * (2 * dr_[j] + dr_[next] + dr_[last]);
        }
        Vec3d total = force;
        for (std::size_t k = 0; k < 4; ++k)
            total -= d[k] * q[k];
        const double m = g_.skeleton_mass[i], e = g_.envelope_mass[i];
        const Vec3d spring{total.x / (m + 2 * e), total.y / (m + 2 * e), total.z / (m + 4 * e)};
        a = spring - v_[i] * drag_;
        for (std::size_t k = 0; k < 4; ++k)
            rr[k] = q[k] / e - drag_ * dr_[4 * i + k] - dot(d[k], spring);
    }

    const Groom& g_;
    double drag_, rho_, thickness_;
    std::size_t n_;
    std::vector<Vec3d> x_, v_;
    std::vector<double> r_, dr_;
};

double growth(const Groom& groom, double drag, double h) {
    Straight wisp(groom, drag, 0.15, 4);
    const double before = wisp.size();
    double largest = 0;
    for (int i = 0; i < 4000; ++i) {
        wisp.step(h);
        largest = std::max(largest, wisp.size());
    }
    return largest / before;
}

} // namespace

TEST_CASE(
    "steps under the limit stay, steps over it blow up, and the parameter at fault is named") {
    struct Case {
        const char* parameter;
        void (*make)(StraightWisp&);
        double drag = 3;
    };
    const Case cases[] = {
        {"skeleton.strain", [](StraightWisp& w) { w.segments = 16, w.radius = 0.03f; }},
        {"skeleton.stretch_damping", [](StraightWisp& w) { w.skeleton.stretch_damping = 4; }},
        {"skeleton.bending_length",
         [](StraightWisp& w) {
             w.skeleton.bending_length = 0.2f, w.skeleton.bending_damping = 0, w.segments = 12;
         }},
        {"skeleton.bending_damping", [](StraightWisp& w) { w.segments = 24; }},
        {"envelope.squeeze", [](StraightWisp& w) { w.radius = 0.004f; }},
        {"envelope.damping",
         [](StraightWisp& w) { w.envelope.damping = 10, w.envelope.ring_damping = 0; }},
        {"envelope.ring_stiffness",
         [](StraightWisp& w) { w.envelope.ring_stiffness = 60, w.envelope.ring_damping = 0; }},
        {"envelope.ring_damping", [](StraightWisp& w) { w.envelope.ring_damping = 12; }},
        {"air.drag", [](StraightWisp&) {}, 5000},
    };
    const Body peg = make_peg();
    for (const Case& c : cases) {
        CAPTURE(c.parameter);
        StraightWisp wisp;
        c.make(wisp);
        const Groom groom = make_groom(std::vector{design(wisp, peg.mesh)}, peg.mesh);
        const StepLimit limit = step_limit(groom, c.drag);
        CHECK(limit.parameter == c.parameter);
        // Away from the limit a step multiplies the fastest mode by 1 ± a tenth at least.
        CHECK(growth(groom, c.drag, 0.99 * limit.step) < 100);
        CHECK(growth(groom, c.drag, 1.15 * limit.step) > 1e6);
    }
}

TEST_CASE(
    "the wisp that limits the step is found among others, and the message says what would do") {
    const Body peg = make_peg();
    StraightWisp stiff;
    stiff.skeleton.strain = 0.0005f;
    const std::vector<WispDesign> wisps = {design({}, peg.mesh), design(stiff, peg.mesh),
                                           design({}, peg.mesh)};
    const Groom groom = make_groom(wisps, peg.mesh);
    const StepLimit limit = step_limit(groom, 3);
    CHECK(limit.wisp == 1);
    // A long chain: ω² = 4 EA/(λ L²), its damping 4 ζ ω, and h² ω² + 2 h 4 ζ ω = 4 at the limit.
    const double l = 0.05, omega = std::sqrt(4 * 9.81 * 0.4 / (0.0005 * l * l)), zeta = 0.05;
    const double expected = (std::sqrt(zeta * zeta * 16 + 4) - 4 * zeta) / omega;
    CHECK(limit.step ==
          doctest::Approx(expected).epsilon(0.08)); // 0.9 of the inertia: 5 %; finite chain
    CHECK_NOTHROW(require_stable_step(groom, 3, 0.99 * limit.step));
    CHECK_THROWS_WITH_AS(
        require_stable_step(groom, 3, 0.001),
        doctest::Contains("wisp 1: steps of 1.000000 ms are unstable, mostly by skeleton.strain; "
                          "the largest stable step is 0.5"),
        InputError);
}
