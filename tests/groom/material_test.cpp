#include "designs.h"

#include <doctest/doctest.h>

#include <numeric>

using namespace mane;
using namespace mane::test;

namespace {

double simulated_length(const Shape& s) {
    return std::accumulate(s.length.begin() + 1, s.length.end(), 0.0);
}

} // namespace

TEST_CASE("a wisp weighs its strands, shared by skeleton and envelope") {
    for (std::uint32_t points : {3u, 4u, 7u}) {
        const WispDesign d = curled(11, points);
        const Balance b = balance(d);
        const double lambda = double{d.skeleton.strand_mass} * d.strands;
        double total = 0;
        for (std::size_t i = 0; i < b.shape.sections(); ++i)
            total += b.material.skeleton_mass[i] + points * b.material.envelope_mass[i];
        CHECK(total == doctest::Approx(lambda * simulated_length(b.shape)).epsilon(1e-13));
        CHECK(b.material.section_mass.front() == 0);
        CHECK(b.material.section_mass.back() ==
              doctest::Approx(lambda * b.shape.length.back() / 2).epsilon(1e-13));
        CHECK(points * b.material.envelope_mass[3] / b.material.section_mass[3] ==
              doctest::Approx(double{d.envelope.mass_share}).epsilon(1e-13));
    }
}

TEST_CASE("a wisp that hangs under its own weight is stretched by `strain` at the root") {
    // The root segment carries all but half of itself: ε (1 − 1/2N), whatever the segments.
    for (std::uint32_t segments : {1u, 4u, 8u, 32u}) {
        const Body peg = make_peg();
        const StraightWisp wisp = hanging(segments);
        const Groom groom = make_groom(std::vector{design(wisp, peg.mesh)}, peg.mesh);
        const double l = length(Vec3d(groom.position[2]) - Vec3d(groom.position[1]));
        const double expected = double{wisp.skeleton.strain} * (1 - 0.5 / segments);
        // l and L are floats: 2⁻²⁴ of a length each, and the positions of about the wisp's length
        CHECK(l / double{groom.rest_length[1]} - 1 ==
              doctest::Approx(expected).epsilon(3e-7 * segments / expected));
    }
}

TEST_CASE("springs follow the parameters' definitions") {
    const WispDesign d = curled(12);
    const Balance b = balance(d);
    const double g = 9.81, lambda = double{d.skeleton.strand_mass} * d.strands;
    const auto mean = [&](std::size_t i) { return mean_radius(d, i); };
    for (std::size_t i = 1; i < b.shape.segments(); ++i) {
        const double thickness = std::pow(mean(i) / mean(1), double{d.skeleton.thickness_power});
        const double spacing =
            i == 1 ? b.rest.length[1] / 2 : (b.rest.length[i - 1] + b.rest.length[i]) / 2;
        const double ei = lambda * g * std::pow(double{d.skeleton.bending_length}, 3) * thickness;
        CHECK(b.rest.bend_stiffness[i] == doctest::Approx(ei / spacing).epsilon(1e-12));
    }
    // A radius under the weight of its whole section, times the ramp's inverse, is squeezed by q.
    for (std::size_t i : {std::size_t{1}, b.shape.sections() - 1}) {
        const double rest = mean(i), k0 = b.material.radial_stiffness[i];
        const double rho = 1 - double{d.envelope.squeeze};
        const double s =
            i == 1 ? double{d.envelope.stiffness.root} : double{d.envelope.stiffness.tip};
        CHECK(0.5 * k0 * rest * (1 / rho - rho) ==
              doctest::Approx(s * b.material.section_mass[i] * g).epsilon(1e-12));
    }
}

TEST_CASE("a period does not depend on the segments: the first joint is clamped, the others share "
          "the rod") {
    // Compliance of a straight uniform rod to a moment at its tip: Σ 1/k = S/EI but for the last
    // half segment.
    for (std::uint32_t segments : {4u, 8u, 32u}) {
        const Body peg = make_peg();
        StraightWisp wisp = hanging(segments);
        wisp.radius = 0.01f;
        wisp.skeleton.strain = 1e-6f;
        const Balance b = balance(design(wisp, peg.mesh));
        double compliance = 0;
        for (std::size_t i = 1; i < b.shape.segments(); ++i)
            compliance += 1 / b.rest.bend_stiffness[i];
        const double total = double{wisp.length} / b.material.bend_rigidity[1];
        CHECK(compliance == doctest::Approx(total * (1 - 0.5 / segments)).epsilon(1e-5));
    }
}
