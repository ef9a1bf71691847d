#include "base/random.h"
#include "bodies/brute_surface.h"
#include "bodies/meshes.h"
#include "interactions/toy_hair.h"
#include "mane/error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>

using namespace mane;
using namespace mane::test;

namespace {

Vec3 random_vec(const Random& random, std::uint64_t n, float size) {
    return {random.between(3 * n, -size, size), random.between(3 * n + 1, -size, size),
            random.between(3 * n + 2, -size, size)};
}

Vec3d still(std::size_t, double, const Vec3d& rest) {
    return rest;
}

/// A floor whose top is at y = 0.
Mesh floor_mesh() {
    return box({-1, -0.5f, -1}, {1, 0, 1}, 8);
}

/// A wisp whose simulated points lie side by side, x₀ and x₁ far above them.
ToyHair resting_hair(float height, float radius, std::uint32_t k = 4) {
    return ToyHair(
        {{{0, 1.1f, 0}, {0, 1, 0}, {-0.05f, height, 0}, {0, height, 0}, {0.05f, height, 0}}}, k,
        radius);
}

/// A wisp of bare skeleton points that hardly touch each other's business: three of them.
ToyHair bare_hair(float height) {
    return resting_hair(height, 0);
}

void set_velocity(ToyHair& hair, const Vec3& v) {
    for (std::uint32_t i = 2; i < hair.groom.sections(0); ++i)
        hair.state.velocity.set(hair.slot(0, i), v);
}

constexpr float kImpulse = 1e-5f; // [N·s]

/// The velocity of a point of wisp 0 along a unit direction before and after an impulse along it,
/// and the inverse mass that it met. The velocity is checked against the one of WispCopy.
struct Pushed {
    float before, after, inverse_mass;
};
template <int kFours> Pushed pushed(ToyHair& hair, const WispPoint& point, const Vec3& e) {
    const auto speed = [&] {
        WispCopy wisp;
        wisp.load(hair.view(), 0);
        return dot(wisp.velocity(point), e);
    };
    const HairView view = hair.view();
    WispMotion<kFours> wisp;
    wisp.begin(view);
    wisp.load(0, 0, 5);
    MotionRow<kFours> row;
    wisp.find_row(point, four(e), row);
    Pushed pushed{speed(), 0, wisp.weigh(row)};
    CHECK(wisp.along(row) == doctest::Approx(pushed.before).epsilon(1e-5));
    wisp.push(row, kImpulse);
    wisp.store(hair.state);
    pushed.after = speed();
    return pushed;
}

} // namespace

TEST_CASE("an impulse at any point of a wisp changes its velocity by the inverse mass, and the "
          "energy by the work") {
    const Random random(11, 0);
    for (std::uint64_t n = 0; n < 500; ++n) {
        const std::uint32_t k = 3 + static_cast<std::uint32_t>(n % 4);
        ToyHair hair({ToyHair::straight({0, 0, 0}, random_vec(random, 100 + n, 0.1f), 5)}, k,
                     0.02f);
        for (std::uint32_t i = 2; i < 5; ++i) {
            hair.state.velocity.set(hair.slot(0, i), random_vec(random, 10000 + 7 * n + i, 1));
            for (std::uint32_t line = 0; line < k; ++line)
                hair.state.radius_rate.at(hair.slot(0, i), line) =
                    random.between(50000 + 97 * n + 13 * i + line, -1, 1);
        }
        const WispPoint point{1 + static_cast<std::uint32_t>(n % 3), n % 2 ? 0.3f : 0,
                              static_cast<std::uint32_t>(n % k),
                              n % 5 ? random.unit(900000 + n) : 0,
                              n % 5 ? random.unit(910000 + n) : 0};
        const Vec3 e = normalized(random_vec(random, 200000 + n, 1));
        const double energy = hair.energy({});
        const auto [before, after, inverse_mass] =
            k <= 4 ? pushed<1>(hair, point, e) : pushed<2>(hair, point, e);
        CHECK(after - before == doctest::Approx(kImpulse * inverse_mass).epsilon(1e-3));
        const double work = double(kImpulse) * double(before + after) / 2;
        CHECK(hair.energy({}) - energy == doctest::Approx(work).epsilon(1e-3));
    }
}

TEST_CASE("a point dropped on a floor stops at the threshold, without rebound") {
    for (float speed : {0.1f, 1.0f, 5.0f, 15.0f}) {
        ToyHair hair = bare_hair(0.1f);
        set_velocity(hair, {0, -speed, 0});
        ToyRun run(hair, {floor_mesh()});
        for (int b = 0; b < 120; ++b) {
            run.block(still);
            CHECK(hair.v(0, 3).y < 1e-6f);
            CHECK(hair.x(0, 3).y > run.desc.threshold * 0.999f);
        }
        CHECK(hair.x(0, 3).y == doctest::Approx(double(run.desc.threshold)).epsilon(1e-3));
        CHECK(length(hair.v(0, 3)) < 1e-6f);
        CHECK(run.reactions == 0);
    }
}

TEST_CASE("a point dropped on a sphere stops at the threshold") {
    ToyHair hair({{{0, 1.1f, 0}, {0, 1, 0}, {0, 0.2f, 0}}}, 4, 0);
    ToyRun run(hair, {icosphere(4, 0.1f)});
    for (int b = 0; b < 60; ++b)
        run.block(still);
    CHECK(length(hair.x(0, 2)) == doctest::Approx(0.104).epsilon(2e-3));
    CHECK(length(hair.v(0, 2)) < 1e-3f);
}

TEST_CASE("a moving floor gives a point its own velocity along its normal, exactly (M30)") {
    for (double speed : {0.5, 2.0, 4.0}) {
        ToyHair hair = bare_hair(0.02f);
        ToyRun run(hair, {floor_mesh()});
        run.gravity = {};
        for (int b = 0; b < 20; ++b)
            run.block([&](std::size_t, double t, const Vec3d& p) {
                return p + Vec3d{0, speed * t, 0};
            });
        CHECK(double(hair.v(0, 3).y) == doctest::Approx(speed).epsilon(1e-4));
        CHECK(double(hair.x(0, 3).y) - speed * run.time ==
              doctest::Approx(double(run.desc.threshold)).epsilon(2e-3));
        CHECK(run.reactions == 0);
    }
}

TEST_CASE("a turning floor gives a point the velocity of the plane where the point is") {
    ToyHair hair = bare_hair(0.005f);
    ToyRun run(hair, {floor_mesh()});
    run.gravity = {};
    run.desc.friction = 0;
    const double omega = 4; // about z: to the right of the axis the floor rises
    for (int b = 0; b < 4; ++b) {
        run.block([&](std::size_t, double t, const Vec3d& p) {
            const double c = std::cos(omega * t), s = std::sin(omega * t);
            return Vec3d{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
        });
    }
    const Vec3d x(hair.x(0, 4));
    const double angle = omega * run.time;
    const Vec3d normal{-std::sin(angle), std::cos(angle), 0};
    CHECK(dot(x, normal) == doctest::Approx(double(run.desc.threshold)).epsilon(0.1));
    CHECK(dot(Vec3d(hair.v(0, 4)), normal) ==
          doctest::Approx(omega * dot(x, Vec3d{normal.y, -normal.x, 0})).epsilon(0.05));
}

TEST_CASE("drag on the skin decays as exp(-ct), whatever the step and the number of contacts") {
    const auto rate = [](float radius, int steps) {
        ToyHair hair = resting_hair(0.003f + radius, radius);
        set_velocity(hair, {0, 0, 1}); // across the wisp's axis
        ToyRun run(hair, {floor_mesh()});
        run.gravity = {};
        run.steps_per_block = steps;
        run.dt = 0.008f / float(steps);
        for (int b = 0; b < 10; ++b)
            run.block(still);
        return -std::log(double(hair.v(0, 3).z)) / run.time;
    };
    for (int steps : {1, 8, 40}) {
        CHECK(rate(0, steps) ==
              doctest::Approx(5).epsilon(1e-3)); // K + 1 points of each section touch: still 5 /s
        // Resting on its envelope, it leaves behind the points whose half lines lie along the
        // motion: 1/10 of the mass.
        CHECK(rate(0.003f, steps) == doctest::Approx(rate(0.003f, 20)).epsilon(0.01));
        CHECK(rate(0.003f, steps) > 4);
        CHECK(rate(0.003f, steps) < 5);
    }
}

TEST_CASE("an envelope point pressed by a floor pushes its skeleton point (M13, M27)") {
    ToyHair hair = resting_hair(0.02f, 0.017f);
    set_velocity(hair, {0, -1, 0});
    ToyRun run(hair, {floor_mesh()});
    run.gravity = {};
    run.spring = 1;
    run.spring_length = 0.017f;
    run.block(still);
    CHECK(hair.v(0, 3).y > -1);
    CHECK(hair.state.radius_rate.at(hair.slot(0, 3), 0) > -2);
    for (int b = 0; b < 60; ++b)
        run.block(still);
    CHECK(hair.v(0, 3).y >
          -1e-3f); // turned round by its springs alone: the skeleton never came near
    CHECK(hair.x(0, 3).y > 0.008f);
}

TEST_CASE("energy in the polygons' frame never rises through the answers") {
    const Random random(5, 5);
    const Mesh sphere = icosphere(3, 0.1f);
    Surface surface(sphere);
    int engaged = 0;
    for (std::uint64_t n = 0; n < 3000; ++n) {
        const Vec3 start = normalized(random_vec(random, n, 1)) * 0.112f;
        ToyHair hair({ToyHair::straight(start, random_vec(random, 5000 + n, 0.03f), 6)}, 3 + n % 4,
                     random.between(70000 + n, 0, 0.02f));
        const Vec3 carried = random_vec(random, 20000 + n, 2);
        hair.state.velocity.set(hair.slot(0, 1),
                                carried); // the root rides the body: it does no work in its frame
        for (std::uint32_t i = 2; i < 6; ++i) {
            hair.state.velocity.set(hair.slot(0, i), random_vec(random, 30000 + 8 * n + i, 2));
            for (std::uint32_t line = 0; line < hair.groom.envelope_points; ++line)
                hair.state.radius_rate.at(hair.slot(0, i), line) =
                    random.between(90000 + 60 * n + 9 * i + line, -1, 1);
        }
        surface.reset(sphere.vertices);
        surface.advance(moved(sphere, carried * 0.008f).vertices, 0.008);
        const ContactBody body{&surface, false};
        CharacterContacts contacts;
        Threads threads(1);
        CharacterContactDesc desc;
        desc.threshold = 0.02f;
        contacts.detect(hair.view(), std::span(&body, 1), desc, threads);
        const double before = hair.energy(carried);
        contacts.respond(hair.view(), desc, 0, 0.001f, hair.state, threads);
        engaged += hair.energy(carried) < before * 0.999;
        CHECK(hair.energy(carried) <= before * (1 + 1e-4));
    }
    CHECK(engaged > 1000);
}

TEST_CASE("at rest on a head a wisp is at rest: under 1 mm/s, with springs in its envelope") {
    for (float turn : {0.0f, 0.4f, 0.785f}) {
        for (float side :
             {-0.15f, -0.1f}) { // hanging down the head's side, and from its top over it
            ToyHair hair({{{side, 0.115f, 0},
                           {side + 0.04f, 0.115f, 0},
                           {side + 0.08f, 0.116f, 0.01f},
                           {side + 0.13f, 0.115f, 0.02f},
                           {side + 0.18f, 0.115f, 0}}},
                         4, 0.012f);
            hair.turn = turn;
            hair.find_frames();
            ToyRun run(hair, {icosphere(4, 0.1f)});
            run.stretch = 40000;
            run.rest_length = 0.05f;
            run.spring = 1;
            run.spring_length = 0.012f;
            run.air = 5;
            for (int b = 0; b < 900; ++b)
                run.block(still);
            float fastest = 0;
            for (int b = 0; b < 30; ++b) {
                run.block(still);
                for (std::uint32_t i = 2; i < 5; ++i) {
                    fastest = std::max(fastest, length(hair.v(0, i)));
                    for (std::uint32_t line = 0; line < 4; ++line)
                        fastest = std::max(
                            fastest, std::abs(hair.state.radius_rate.at(hair.slot(0, i), line)));
                }
            }
            CAPTURE(turn);
            CAPTURE(side);
            CHECK(run.contacts.count() > 0);
            CHECK(fastest < 1e-3f);
        }
    }
}

TEST_CASE("contacts and answers have the same bits for any number of threads") {
    std::vector<std::vector<Vec3>> wisps;
    const Random random(9, 9);
    for (std::uint64_t w = 0; w < 150; ++w) {
        const Vec3 out = normalized(random_vec(random, w, 1));
        wisps.push_back(ToyHair::straight(
            out * 0.06f, out * 0.045f + random_vec(random, 700 + w, 0.01f), 4 + int(w % 6)));
    }
    std::vector<std::vector<float>> results;
    for (unsigned count : {1u, 2u, 5u}) {
        ToyHair hair(wisps, 4, 0.012f);
        ToyRun run(hair, {icosphere(3, 0.1f), moved(icosphere(2, 0.05f), {0.12f, -0.05f, 0})},
                   count);
        run.spring = 1;
        run.spring_length = 0.012f;
        for (int b = 0; b < 10; ++b) {
            run.block([](std::size_t, double t, const Vec3d& p) {
                return p + Vec3d{0.1 * std::sin(9 * t), 0.05 * std::sin(20 * t), 0};
            });
        }
        std::vector<float> bits;
        for (const Rows* rows : {&hair.state.position, &hair.state.velocity, &hair.state.radius,
                                 &hair.state.radius_rate})
            bits.insert(bits.end(), rows->all().begin(), rows->all().end());
        CHECK(run.reactions > 0);
        results.push_back(bits);
    }
    for (const auto& other : results) {
        REQUIRE(other.size() == results[0].size());
        CHECK(std::memcmp(other.data(), results[0].data(), other.size() * sizeof(float)) == 0);
    }
}

TEST_CASE("contacts are sorted by section") {
    ToyHair hair({ToyHair::straight({-0.2f, 0.015f, 0}, {0.05f, 0, 0}, 8)}, 4, 0.012f);
    ToyRun run(hair, {floor_mesh(), moved(floor_mesh(), {0, -0.002f, 0})});
    run.block(still);
    const auto contacts = run.contacts.of_wisp(0);
    REQUIRE(contacts.size() > 8);
    for (std::size_t c = 1; c < contacts.size(); ++c)
        CHECK(contacts[c - 1].point.section <= contacts[c].point.section);
}

TEST_CASE("a fast fin never leaves a point inside, nor lets it through") {
    const Mesh fin = box({-0.002f, -0.1f, -0.1f}, {0.002f, 0.1f, 0.1f}, 10);
    const Random random(21, 0);
    for (std::uint64_t n = 0; n < 60; ++n) {
        const double speed = double(random.between(n, 0.5f, 20));
        const double start = -0.1 - double(random.unit(1000 + n)) * 0.1;
        ToyHair hair(
            {{{0, 0.3f, 0}, {0, 0.2f, 0}, {0, 0.05f, 0}, {0.01f, 0.01f, 0.01f}, {0, -0.04f, 0}}}, 4,
            0.004f);
        ToyRun run(hair, {fin});
        run.gravity = {};
        const auto place = [&](std::size_t, double t, const Vec3d& p) {
            return p + Vec3d{std::min(start + speed * t, 0.15), 0, 0};
        };
        const ClosedMesh closed = close_borders(fin);
        bool inside = false, through = false;
        while (start + speed * run.time < 0.15) {
            run.block(place);
            for (std::uint32_t i = 2; i < 5; ++i) {
                const Vec3d p(hair.x(0, i));
                inside |= winding_number(closed, run.now[0].vertices, p) > 0.5;
                through |= p.x < std::min(start + speed * run.time, 0.15) &&
                           std::abs(p.y) < 0.095 && std::abs(p.z) < 0.095;
            }
        }
        CAPTURE(speed);
        CHECK_FALSE(inside);
        CHECK_FALSE(through);
    }
}

TEST_CASE("no point stays inside a body that moves, turns and is concave, at any speed") {
    const Mesh body =
        together(icosphere(3, 0.1f), together(torus(32, 12, 0.12f, 0.02f),
                                              moved(icosphere(2, 0.04f), {0.08f, 0.06f, 0})));
    const Random random(33, 0);
    for (std::uint64_t n = 0; n < 12; ++n) {
        std::vector<std::vector<Vec3>> wisps;
        for (std::uint64_t w = 0; w < 10; ++w) {
            const Vec3 out = normalized(random_vec(random, 100 * n + w, 1));
            wisps.push_back(ToyHair::straight(
                out * 0.145f, out * 0.02f + random_vec(random, 5000 + 100 * n + w, 0.02f), 8));
        }
        ToyHair hair(wisps, 4, 0.01f);
        ToyRun run(hair, {body});
        const double speed = double(random.between(9000 + n, 1, 20)),
                     omega = double(random.between(9100 + n, 0, 20));
        const ClosedMesh closed = close_borders(body);
        int inside = 0;
        for (int b = 0; b < 12; ++b) {
            run.block([&](std::size_t, double t, const Vec3d& p) {
                const double c = std::cos(omega * t), s = std::sin(omega * t);
                return Vec3d{c * p.x + s * p.z + speed * t, p.y, c * p.z - s * p.x};
            });
            for (std::uint32_t w = 0; w < 10; ++w) {
                // x₁ is left behind here: no rule is broken only while it is outside
                if (winding_number(closed, run.now[0].vertices, Vec3d(hair.x(w, 1))) > 0.5)
                    continue;
                for (std::uint32_t i = 2; i < 8; ++i)
                    inside +=
                        winding_number(closed, run.now[0].vertices, Vec3d(hair.x(w, i))) > 0.5;
            }
        }
        CHECK(inside == 0);
    }
}

TEST_CASE("in a crease a point has a plane for each wall, and rests on both") {
    // floor and wall of one body that overlap: the inner wall below the floor must not be found
    const Mesh corner = together(floor_mesh(), box({-0.5f, -0.4f, -0.5f}, {-0.1f, 0.4f, 0.5f}, 6));
    ToyHair hair({{{0, 0.4f, 0}, {0, 0.3f, 0}, {-0.093f, 0.007f, 0.01f}}}, 4, 0);
    ToyRun run(hair, {corner});
    run.gravity = {-7, -7, 0};
    run.block(still);
    const auto contacts = run.contacts.of_wisp(0);
    REQUIRE(contacts.size() >= 2);
    int floors = 0, walls = 0;
    for (const SlidingContact& c : contacts) {
        floors += c.normal.y > 0.999f && c.point.along == 0 && c.point.alpha == 0;
        walls += c.normal.x > 0.999f && c.point.along == 0 && c.point.alpha == 0;
    }
    CHECK(floors == 1);
    CHECK(walls == 1);
    for (int b = 0; b < 100; ++b)
        run.block(still);
    CHECK(double(hair.x(0, 2).x) == doctest::Approx(-0.096).epsilon(1e-3));
    CHECK(double(hair.x(0, 2).y) == doctest::Approx(0.004).epsilon(1e-2));
    CHECK(length(hair.v(0, 2)) < 1e-4f);
    CHECK(run.reactions == 0);
}

TEST_CASE("between two surfaces that pinch, a point keeps to the middle of the gap") {
    const float gap = 0.004f; // half of twice the threshold
    const Mesh walls = together(box({-0.5f, -0.2f, -0.2f}, {-gap / 2, 0.2f, 0.2f}, 6),
                                box({gap / 2, -0.2f, -0.2f}, {0.5f, 0.2f, 0.2f}, 6));
    ToyHair hair({{{0, 0.4f, 0}, {0, 0.3f, 0}, {0.0005f, 0.05f, 0.01f}}}, 4, 0);
    ToyRun run(hair, {walls});
    run.gravity = {3, 0, 0};
    run.block(still);
    int halves = 0;
    for (const SlidingContact& c : run.contacts.of_wisp(0))
        halves += c.threshold == doctest::Approx(double(gap / 2)).epsilon(1e-3) &&
                  c.point.along == 0 && c.point.alpha == 0;
    CHECK(halves == 2);
    for (int b = 0; b < 60; ++b)
        run.block(still);
    CHECK(std::abs(hair.x(0, 2).x) < gap / 2);
    CHECK(length(hair.v(0, 2)) < 1e-4f);

    // pressed into a wall it comes out to the middle, not into the other one
    hair.state.position.set(hair.slot(0, 2), {0.01f, 0.05f, 0.01f});
    run.block(still);
    CHECK(std::abs(hair.x(0, 2).x) < gap * 0.3f);
}

TEST_CASE("an axis through a convex part is lifted out of it") {
    ToyHair hair({{{-0.3f, 0.1f, 0},
                   {-0.2f, 0.1f, 0},
                   {-0.06f, 0.05f, 0},
                   {0.06f, 0.05f, 0},
                   {0.2f, 0.05f, 0}}},
                 4, 0.002f);
    ToyRun run(hair, {icosphere(4, 0.06f)});
    run.gravity = {};
    run.block(still);
    for (std::uint32_t i = 2; i < 5; ++i)
        CHECK_FALSE(run.surfaces[0]->end().crosses(Vec3d(hair.x(0, i - 1)), Vec3d(hair.x(0, i))));
    CHECK(run.reactions > 0);
}

TEST_CASE("two crossings of a spring leave its far end alone (M31)") {
    // a thin rod between the skeleton point and one of its envelope points
    const Mesh rod = box({-0.2f, -0.001f, 0.009f}, {0.2f, 0.001f, 0.011f}, 1);
    ToyHair hair = resting_hair(0, 0.02f);
    hair.state.position.set(hair.slot(0, 1), {-0.3f, 0, 0});
    hair.state.position.set(hair.slot(0, 0), {-0.4f, 0, 0});
    hair.find_frames();
    ToyRun run(hair, {rod});
    run.gravity = {};
    run.contacts.react(hair.view(), run.bodies(), run.desc, hair.state, run.threads);
    for (std::uint32_t line = 0; line < 4; ++line)
        CHECK(hair.state.radius.at(hair.slot(0, 3), line) == 0.02f);
}

TEST_CASE("envelope and drawn surface come back to the body's surface") {
    ToyHair hair({{{-0.15f, 0.11f, 0},
                   {-0.1f, 0.11f, 0},
                   {-0.05f, 0.105f, 0},
                   {0, 0.108f, 0},
                   {0.05f, 0.105f, 0}}},
                 4, 0.02f);
    const Mesh sphere = icosphere(4, 0.1f);
    ToyRun run(hair, {sphere});
    const Vec3 middle = hair.x(0, 3);
    run.contacts.react(hair.view(), run.bodies(), run.desc, hair.state, run.threads);
    CHECK(hair.x(0, 3) == middle); // outside: left where it is
    WispCopy wisp;
    wisp.load(hair.view(), 0);
    for (std::uint32_t i = 2; i < 5; ++i) {
        for (std::uint32_t line = 0; line < 4; ++line) {
            for (float a : {1.0f, 0.924f, 0.707f, 0.383f}) {
                const Vec3 p = wisp.position({i, 0, line, a, std::sqrt(1 - a * a)});
                CHECK(length(p) > 0.0985f); // between the tested directions it may sink by little
            }
        }
        CHECK(wisp.largest_radius(i) == doctest::Approx(0.02));
    }
    CHECK(wisp.r(3, 2) == doctest::Approx(0.008).epsilon(0.03)); // the half line straight down
}

TEST_CASE("a root inside a body is an input error that names the wisp, unless the body is worn") {
    ToyHair hair(
        {{{0, 0.3f, 0}, {0, 0.2f, 0}, {0, 0.25f, 0}}, {{0, 0.05f, 0}, {0, 0.09f, 0}, {0, 0.2f, 0}}},
        4, 0);
    const Surface surface(icosphere(3, 0.1f));
    const std::string name = "the head";
    const ContactBody body{&surface, false}, hat{&surface, true};
    CHECK_THROWS_WITH_AS(check_roots(hair.view(), std::span(&body, 1), std::span(&name, 1)),
                         doctest::Contains("wisp 1"), InputError);
    CHECK_NOTHROW(check_roots(hair.view(), std::span(&hat, 1), std::span(&name, 1)));
}

TEST_CASE("a worn body leaves the part of a wisp that starts inside it alone, and meets the rest") {
    ToyHair hair({ToyHair::straight({0, 0.05f, 0}, {0, 0.02f, 0}, 8)}, 4, 0);
    ToyRun run(hair, {icosphere(3, 0.1f)});
    run.worn = {true};
    run.gravity = {0, -9.81f, 0};
    run.block(still);
    CHECK(length(hair.x(0, 2)) < 0.1f); // as it was, falling
    CHECK(hair.x(0, 2).y < 0.09f);
    for (int b = 0; b < 60; ++b)
        run.block(still);
    CHECK(length(hair.x(0, 6)) > 0.1f); // held by the hat
}
