#include "mane/error.h"
#include "synthetic_run.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace mane;
using mane::test::SyntheticRun;

TEST_CASE("kinetic energy is that of every point, and the wisps' sum is the head's") {
    SyntheticRun run = test::good_run();
    run.frames.resize(2);
    run.poses.resize(2);
    for (Vec3& v : run.frames[1].velocity)
        v = {3, 0, 4};
    std::fill(run.frames[1].radius_rate.begin(), run.frames[1].radius_rate.end(), 0.f);
    const std::vector<FrameFigures> figures = run.figures();
    REQUIRE(figures.size() == 2);
    const Groom& g = run.setup.groom;
    double mass = 0, of_wisp_1 = 0;
    for (std::size_t w = 0; w < g.wisp_count(); ++w)
        for (std::size_t s = g.first_section[w] + 2; s < g.first_section[w + 1]; ++s) {
            const double m = g.skeleton_mass[s] + double{g.envelope_mass[s]} * g.envelope_points;
            mass += m;
            of_wisp_1 += w == 1 ? m : 0;
        }
    CHECK(figures[1].kinetic_energy == doctest::Approx(0.5 * mass * 25).epsilon(1e-6));
    CHECK(figures[1].wisp_kinetic_energy[1] == doctest::Approx(0.5 * of_wisp_1 * 25).epsilon(1e-6));
    CHECK(figures[1].penetration == 0);
}

TEST_CASE("volume is that of straight round wisps, and grows with the radii squared") {
    SyntheticRun run = test::good_run();
    run.frames.resize(2);
    run.poses.resize(2);
    const float r = 0.01f;
    double along = 0;
    for (std::size_t w = 0; w < run.setup.groom.wisp_count(); ++w)
        for (std::size_t i = 2; i <= test::kTip; ++i)
            along += length(Vec3d(run.position(0, w, i)) - Vec3d(run.position(0, w, i - 1)));
    for (std::size_t frame = 0; frame < 2; ++frame)
        std::fill(run.frames[frame].radius.begin(), run.frames[frame].radius.end(),
                  frame == 0 ? r : 2 * r);
    run.frames[1].position = run.frames[0].position;
    const std::vector<FrameFigures> figures = run.figures();
    CHECK(figures[0].volume ==
          doctest::Approx(std::numbers::pi * double{r} * double{r} * along).epsilon(1e-5));
    CHECK(figures[1].volume == doctest::Approx(4 * figures[0].volume).epsilon(1e-5));
}

TEST_CASE("penetration is the depth of the deepest point in a body that is not worn") {
    SyntheticRun run = test::good_run();
    run.frames.resize(1);
    run.poses.resize(1);
    // A box of 40 mm round a skeleton point of wisp 0, which is 15 mm under its +x side.
    const Vec3 p = Vec3(Vec3d(run.position(0, 0, 5)) + run.frames[0].origin);
    std::fill(run.frames[0].radius.begin(), run.frames[0].radius.end(), 0.001f);
    ObstacleDesc box;
    box.size = {0.04f, 0.04f, 0.04f};
    for (const bool worn : {false, true}) {
        SyntheticRun with = run;
        Mesh mesh = obstacle_mesh(box);
        for (Vec3& v : mesh.vertices)
            v += p + Vec3{-0.005f, 0, 0};
        with.add_obstacle(mesh, worn);
        const double depth = with.figures()[0].penetration;
        if (worn) {
            CHECK(depth == 0);
        } else {
            // The skeleton point itself, or an envelope point 1 mm beside it.
            CHECK(depth > 0.0149);
            CHECK(depth < 0.0165);
        }
    }
    run.position(0, 1, 4).y = std::numeric_limits<float>::infinity();
    CHECK_THROWS_WITH_AS(run.figures(), "frame 0 holds a number that is not finite", InputError);
}
