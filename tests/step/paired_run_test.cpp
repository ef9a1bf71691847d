/// Whole runs of the core beside the twin, from the same hair on the same moving head.

#include "mane/style.h"
#include "reference/random_numbers.h"
#include "step/paired.h"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

using namespace mane;
using test::Pair, test::Paired;

namespace {

/// A peg that turns to and fro while it walks.
class Shake final : public Motion {
  public:
    std::size_t bone_count() const override { return 1; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        const double w = 2 * std::numbers::pi * 1.5, size = 0.6;
        const double half = size / 2 * std::sin(w * time);
        bones[0].rotation = {0, std::sin(half), 0, std::cos(half)};
        bones[0].angular_velocity = {0, size * w * std::cos(w * time), 0};
        bones[0].position = {0.5 * time, 0, 0.03 * std::sin(1.3 * w * time)};
        bones[0].velocity = {0.5, 0, 0.03 * 1.3 * w * std::cos(1.3 * w * time)};
    }
};

/// A bundle of wisps of mixed lengths that overlap, no two bundles the same.
Groom bundle(const Mesh& peg, float spacing, std::uint64_t seed) {
    reference::RandomNumbers random(seed);
    std::vector<WispDesign> wisps;
    for (std::uint32_t i = 0; i < 12; ++i) {
        StraightWisp wisp;
        wisp.segments = 4 + i % 5;
        wisp.length = 0.25f + 0.01f * static_cast<float>(i);
        wisp.radius = {0.02f, 0.01f};
        WispDesign one = design(wisp, peg);
        const Vec3 place = {static_cast<float>(i % 4) - 1.5f, 0, static_cast<float>(i / 4) - 1};
        const Vec3 offset = place * spacing + Vec3(random.vector(0.002));
        for (Vec3& p : one.position)
            p += offset;
        wisps.push_back(one);
    }
    return make_groom(wisps, peg);
}

/// What a run is like: means over its frames.
struct Outcome {
    double energy = 0; ///< kinetic energy per mass, relative to the walk [J/kg]
    double radius = 0; ///< over rest
    double tip = 0;    ///< height of the tips over the roots [m]
    double sliding = 0, colliding = 0, on_body = 0; ///< contacts per frame

    void add(const reference::Hair& hair, double share) {
        double kinetic = 0, mass = 0, radii = 0, points = 0;
        for (reference::Wisp wisp : hair.wisps) {
            for (Vec3d& v : wisp.v)
                v -= Vec3d{0.5, 0, 0};
            kinetic += reference::energy(wisp, {}).kinetic;
            for (std::size_t i = 2; i < wisp.sections(); ++i) {
                mass += wisp.skeleton_mass[i] +
                        static_cast<double>(wisp.points()) * wisp.envelope_mass[i];
                for (std::size_t k = 0; k < wisp.points(); ++k) {
                    radii += wisp.r[i][k] / wisp.design_radius[i][k];
                    points += 1;
                }
            }
            tip += share * (wisp.x.back().y - wisp.x[1].y) / static_cast<double>(hair.wisps.size());
        }
        energy += share * kinetic / mass;
        radius += share * radii / points;
    }
    void count(const Statistics& statistics, double share) {
        sliding = share * static_cast<double>(statistics.friction_contacts);
        colliding = share * static_cast<double>(statistics.collision_contacts);
        on_body = share * static_cast<double>(statistics.sliding_contacts);
    }
};

double apart(const reference::Hair& a, const reference::Hair& b) {
    double farthest = 0;
    for (std::size_t w = 0; w < a.wisps.size(); ++w)
        for (std::size_t i = 0; i < a.wisps[w].sections();
             ++i) // relative to the roots: origins differ
            farthest = std::max(farthest, length(a.wisps[w].x[i] - a.wisps[w].x[1] -
                                                 (b.wisps[w].x[i] - b.wisps[w].x[1])));
    return farthest;
}

Body shaking_peg() {
    Body peg = make_peg(0.2f);
    peg.motion = std::make_shared<Shake>();
    return peg;
}

/// Comes along with the peg and sweeps into the trailing hair, once a second.
class Sweep final : public Motion {
  public:
    std::size_t bone_count() const override { return 1; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        const double w = 2 * std::numbers::pi;
        bones[0].position = {0.5 * time - 0.04 * std::cos(w * time), 0, 0};
        bones[0].velocity = {0.5 + 0.04 * w * std::sin(w * time), 0, 0};
    }
};

Body obstacle() {
    Body body = make_peg(0.15f);
    body.name = "obstacle";
    for (Vec3& v : body.mesh.vertices)
        v = Vec3{-v.x, v.y, -v.z} + Vec3{-0.11f, -0.2f, 0}; // a flat side to the hair
    body.motion = std::make_shared<Sweep>();
    return body;
}

} // namespace

TEST_CASE(
    "without contacts the core stays with the twin over a second of shaking, to float accuracy") {
    SimulationDesc desc;
    desc.wisps.mode = WispContactMode::off;
    const Body peg = shaking_peg();
    Pair pair(desc, {peg}, bundle(peg.mesh, 0.03f, 1));
    for (int frame = 0; frame < 24; ++frame)
        pair.advance();
    const double difference = apart(pair.core_hair(), pair.twin.hair());
    MESSAGE("farthest section " << 1e6 * difference << " µm apart after 1 s");
    CHECK(difference < 1e-4);
}

TEST_CASE("with all contacts the core's runs are like the twin's, on average over seeds") {
    constexpr int kFrames = 24, kSeeds = 8;
    const Body peg = shaking_peg();
    std::vector<Paired> measures = {{"energy"},  {"radius"},    {"tip"},
                                    {"sliding"}, {"colliding"}, {"on body"}};
    std::uint64_t reactions = 0;
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        Pair pair({}, {peg, obstacle()}, bundle(peg.mesh, 0.015f, seed));
        Outcome core, twin;
        for (int frame = 0; frame < kFrames; ++frame) {
            pair.advance();
            core.add(pair.core_hair(), 1.0 / kFrames);
            twin.add(pair.twin.hair(), 1.0 / kFrames);
        }
        core.count(pair.core.statistics(), 1.0 / kFrames);
        twin.count(pair.twin.statistics(), 1.0 / kFrames);
        reactions += pair.core.statistics().penetration_reactions;
        const auto numbers = [](const Outcome& o) {
            return std::vector<double>{o.energy,  o.radius,    o.tip,
                                       o.sliding, o.colliding, o.on_body};
        };
        for (std::size_t m = 0; m < measures.size(); ++m) {
            measures[m].core.push_back(numbers(core)[m]);
            measures[m].twin.push_back(numbers(twin)[m]);
        }
    }
    for (const Paired& m : measures) {
        MESSAGE(m.name << ": " << Paired::mean(m.core) << " and " << Paired::mean(m.twin)
                       << ", standard error " << 100 * m.standard_error() / m.scale() << " %");
        CHECK(m.scale() > 0);
        CHECK(m.agree());
        CHECK(m.standard_error() < 0.05 * m.scale());
    }
    CHECK(reactions > 100); // the body reaches deep into the hair
}
