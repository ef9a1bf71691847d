/// The skeleton against closed forms: chain, rod, heavy rod.

#include "reference/single_wisp.h"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

using namespace mane;
using namespace mane::reference;

namespace {

const Surroundings kVacuum = {.gravity = {0, -9.81, 0}, .air_drag = 0};

SingleWisp chain(std::uint32_t segments) {
    SingleWisp shape;
    shape.segments = segments;
    shape.bending_length = 0;
    shape.strain = 5e-4;
    return shape;
}

double section_mass(const Wisp& wisp, std::size_t i) {
    return wisp.skeleton_mass[i] + static_cast<double>(wisp.points()) * wisp.envelope_mass[i];
}

/// The chain as it hangs: segment i carries the weight of all masses below it.
void hang(Wisp& wisp) {
    for (std::size_t i = 1; i + 1 < wisp.sections(); ++i) {
        double below = 0;
        for (std::size_t j = i + 1; j < wisp.sections(); ++j)
            below += section_mass(wisp, j);
        const double strain = below * 9.81 / wisp.stretch_stiffness[i];
        wisp.x[i + 1] = wisp.x[i] - Vec3d{0, wisp.rest_length[i] * (1 + strain), 0};
    }
}

/// Mean period of the tip's swing along x, from its first and last crossings of zero.
double swing_period(Wisp wisp, const Surroundings& surroundings, double h, double seconds) {
    const Root root = still_root(wisp);
    double first = -1, last = -1, before = wisp.x.back().x;
    int crossings = 0;
    for (double t = h; t < seconds; t += h) {
        step(wisp, root, root, surroundings, h);
        const double now = wisp.x.back().x;
        if ((before < 0) != (now < 0)) {
            last = t - h * now / (now - before);
            if (crossings++ == 0)
                first = last;
        }
        before = now;
    }
    REQUIRE(crossings > 4);
    return 2 * (last - first) / (crossings - 1);
}

} // namespace

TEST_CASE("a hanging chain stretches as λ g (L − s) / EA") {
    for (const std::uint32_t segments : {2u, 4u, 10u}) {
        const SingleWisp shape = chain(segments);
        Wisp wisp = shape.wisp();
        hang(wisp);
        const Accelerations a = accelerations(wisp, kVacuum);
        // Float rest data: ring lengths are off by 6e-8, which 65,000 /s² turns into 1e-4 m/s²
        // along the half lines only.
        for (std::size_t i = 2; i < wisp.sections(); ++i)
            CHECK(std::abs(a.x[i].y) < 1e-8);

        const double lambda = shape.mass_per_length, L = shape.length,
                     EA = lambda * 9.81 * L / shape.strain;
        for (std::size_t i = 1; i + 1 < wisp.sections(); ++i) {
            const double middle = L * (static_cast<double>(i) - 0.5) / segments;
            const double strain = segment_length(wisp, i) / wisp.rest_length[i] - 1;
            CHECK(strain == doctest::Approx(lambda * 9.81 * (L - middle) / EA).epsilon(1e-6));
        }
        CHECK(-wisp.x.back().y ==
              doctest::Approx(L + lambda * 9.81 * L * L / (2 * EA)).epsilon(1e-6));
    }
}

TEST_CASE(
    "a hanging chain swings at 1.2024 √(g/L), within 2 % at 4 segments and better with more") {
    const double omega = 1.2024 * std::sqrt(9.81 / 0.4);
    double error_before = 0.02;
    for (const std::uint32_t segments : {4u, 8u, 16u}) {
        Wisp wisp = chain(segments).wisp();
        hang(wisp);
        const double L = -wisp.x.back().y;
        for (std::size_t i = 2; i < wisp.sections(); ++i) {
            const double from_tip = std::max(1 + wisp.x[i].y / L, 0.0);
            wisp.x[i].x = 1e-4 * L * std::cyl_bessel_j(0.0, 2.404825558 * std::sqrt(from_tip));
        }
        const double period = swing_period(wisp, kVacuum, 0.8e-3 / segments, 3);
        const double error = std::abs(period * omega / (2 * std::numbers::pi) - 1);
        MESSAGE(segments << " segments: period off by " << 100 * error << " %");
        CHECK(error < error_before);
        error_before = error;
    }
}

TEST_CASE("a clamped-free rod vibrates at 3.516 √(EI/λL⁴)") {
    const Surroundings weightless = {.gravity = {}, .air_drag = 0};
    double error_before = 0.06;
    for (const std::uint32_t segments : {4u, 8u, 16u}) {
        SingleWisp shape;
        shape.segments = segments;
        shape.bending_length = 0.25;
        shape.squeeze = 0.02; // a stiff envelope, that follows
        Wisp wisp = shape.wisp();
        const double bL = 1.875104,
                     c = (std::cos(bL) + std::cosh(bL)) / (std::sin(bL) + std::sinh(bL));
        for (std::size_t i = 2; i < wisp.sections(); ++i) {
            const double z = -bL * wisp.x[i].y / shape.length;
            wisp.x[i].x = 1e-5 * (std::cosh(z) - std::cos(z) - c * (std::sinh(z) - std::sin(z)));
        }
        const double EI_over_lambda = 9.81 * std::pow(shape.bending_length, 3);
        const double omega = 3.516 * std::sqrt(EI_over_lambda / std::pow(shape.length, 4));
        const double period = swing_period(wisp, weightless, 0.4e-3 / segments, 3.5);
        const double error = std::abs(period * omega / (2 * std::numbers::pi) - 1);
        MESSAGE(segments << " segments: period off by " << 100 * error << " %");
        CHECK(error < error_before);
        error_before = error / 3; // second order in the segment's length
    }
}

namespace {

struct MasterPoint {
    double gamma, height, width;
};

/// Rows of the cantilever's master curve, empty where the file is missing.
std::vector<MasterPoint> master_curve() {
    const char* data = std::getenv("MANE_DATA");
    const std::string folder = data ? data : MANE_SOURCE_DIR "/../shared/data";
    std::ifstream file(folder + "/validation/cantilever_master_curve.csv");
    std::vector<MasterPoint> points;
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::array<double, 3> value{};
        std::size_t at = 0;
        for (double& v : value) {
            v = std::stod(line.substr(at));
            at = line.find(',', at) + 1;
        }
        points.push_back({value[0], value[1], value[2]});
    }
    return points;
}

/// Distance of a heavy rod's settled tip from where the continuum's is, over the rod's length.
double cantilever_error(const MasterPoint& point, std::uint32_t segments) {
    SingleWisp shape;
    shape.segments = segments;
    shape.direction = {1, 0, 0};
    shape.across = {0, 0, 1};
    shape.strain = 1e-3;
    shape.bending_length = shape.length / std::cbrt(point.gamma);
    const Surroundings thick_air = {.gravity = {0, -9.81, 0}, .air_drag = 12};
    const Wisp wisp = settled(shape.wisp(), thick_air, 0.8e-3 / segments, 2.5);
    CHECK(length(wisp.v.back()) < 1e-3);
    const Vec3d tip = wisp.x.back() / shape.length;
    return std::hypot(tip.x - point.width, tip.y + point.height);
}

} // namespace

TEST_CASE("a heavy rod clamped horizontally sags along the cantilever's master curve") {
    const std::vector<MasterPoint> curve = master_curve();
    if (curve.empty()) {
        CHECK_MESSAGE(std::getenv("CI") == nullptr, "cantilever_master_curve.csv missing");
        MESSAGE("skipped: cantilever_master_curve.csv missing");
        return;
    }
    for (const double gamma : {1.0, 10.0, 100.0}) {
        MasterPoint point = curve.front();
        for (const MasterPoint& p : curve)
            if (std::abs(std::log(p.gamma / gamma)) < std::abs(std::log(point.gamma / gamma)))
                point = p;
        const double coarse = cantilever_error(point, 4), fine = cantilever_error(point, 12);
        MESSAGE("Γ = " << point.gamma << ": tip off by " << 100 * coarse
                       << " % of the length at 4 segments, " << 100 * fine << " % at 12");
        CHECK(coarse < 0.07);
        CHECK(fine < 0.015);
        CHECK(fine < coarse);
    }
}
