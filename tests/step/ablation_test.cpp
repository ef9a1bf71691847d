/// Claims of the envelope and of the schedule, each measured with its mechanism and without it:
/// what a twin would copy, mistake included, is seen here (docs/proofs.md).

#include "mane/style.h"
#include "mane/world.h"
#include "reference/single_wisp.h"
#include "step/core_step.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace mane;

namespace {

/// One wisp of the core, weightless, held at its root.
struct CoreWisp {
    reference::SingleWisp shape;
    CoreStep core;
    Kernels kernels = kernels_for("");
    Ablation ablation;

    explicit CoreWisp(const reference::SingleWisp& s) : shape(s), core(s.groom()) {
        Frame frame;
        frame.position = core.groom.position;
        frame.velocity.resize(frame.position.size());
        frame.radius = core.groom.radius;
        frame.radius_rate.resize(frame.radius.size());
        frame.first_axis = {Vec3(shape.across)};
        core.take(frame);
        core.roots.seconds = 1;
        const Slot lane = core.packet_lane(0);
        const Vec3 held[] = {frame.position[0], frame.position[1], frame.first_axis[0]};
        for (std::uint32_t column = 0; column < RootMotion::count; ++column)
            for (Rows& value : core.roots.value) {
                value.at(lane, 3 * column) = held[column].x;
                value.at(lane, 3 * column + 1) = held[column].y;
                value.at(lane, 3 * column + 2) = held[column].z;
            }
    }

    Slot tip() const { return core.slot(0, core.groom.sections(0) - 1); }
    float& radius(std::uint32_t k) { return core.state.radius.at(tip(), k); }
    float& rate(std::uint32_t k) { return core.state.radius_rate.at(tip(), k); }

    void step() {
        KernelData data = core.data();
        data.wind = nullptr;
        data.gravity = {};
        data.drag = 0;
        data.step = 1e-3f;
        data.ablation = ablation;
        const std::size_t packets = core.layout.packets().size();
        kernels.process_forces(data, 0, packets);
        kernels.process_positions(data, 1, 0, packets);
    }
};

/// How much wider than at rest a section becomes on one axis while it is held at half on the other.
double swelling(const reference::SingleWisp& shape) {
    CoreWisp wisp(shape);
    for (int i = 0; i < 1000; ++i) {
        wisp.step();
        for (const std::uint32_t k : {0u, 2u}) {
            wisp.radius(k) = static_cast<float>(shape.radius / 2);
            wisp.rate(k) = 0;
        }
    }
    return double{wisp.radius(1)} / shape.radius - 1;
}

/// How far a wisp's tip backs off in 0.1 s, in radii, from a wall half a radius inside its
/// envelope.
double backing_off(const Ablation& ablation) {
    CoreWisp wisp({});
    wisp.ablation = ablation;
    const float radius = static_cast<float>(wisp.shape.radius);
    const auto along_wall = [&](const Rows& rows) { return rows.vec(wisp.tip()).x; }; // half line 0
    for (int i = 0; i < 100; ++i) {
        const float free = std::max(radius / 2 - along_wall(wisp.core.state.position), 0.f);
        if (wisp.radius(0) > free) {
            wisp.radius(0) = free;
            wisp.rate(0) = -along_wall(wisp.core.state.velocity);
        }
        wisp.step();
    }
    return -double{along_wall(wisp.core.state.position)} / double{radius};
}

WispDesign sideways(const Vec3& root, const Vec3& direction, float bending_length,
                    const Mesh& peg) {
    StraightWisp shape;
    shape.direction = direction;
    shape.length = 0.15f;
    shape.segments = 6;
    shape.radius = 0.015f;
    shape.skeleton.bending_length = bending_length;
    shape.skeleton.bending_damping = 0; // a stiff rod's would ask for 70 µs
    WispDesign wisp = design(shape, peg);
    wisp.first_axis = {0, 1, 0};
    const Vec3 step = direction * (shape.length / static_cast<float>(shape.segments));
    for (std::size_t i = 0; i < wisp.position.size(); ++i)
        wisp.position[i] = root + step * (static_cast<float>(i) - 1);
    return wisp;
}

/// How high over a stiff wisp the axis of a soft one passes that falls across it, at the rates of
/// the paper: the lowest of 0.4 s, −0.15 m once it hangs beside it.
double lowest_crossing(bool hold_contacts) {
    const Body peg = make_peg();
    const std::vector<WispDesign> wisps = {
        sideways({0, -0.15f, 0}, {1, 0, 0}, 0.15f, peg.mesh),
        sideways({0.075f, -0.1f, -0.07f}, {0, 0, 1}, 0.03f, peg.mesh)};
    SimulationDesc desc;
    desc.schedule.integration_rate = 2000; // the stiff one asks for it
    desc.schedule.wisp_rate = 24;
    desc.schedule.hold_contacts = hold_contacts;
    // Balanced without weight, then left to gravity.
    World world(desc, make_groom(wisps, peg.mesh, {}), {peg});
    double lowest = 1;
    for (int i = 0; i < 10; ++i) {
        world.advance();
        const std::vector<Vec3>& x = world.frame().position;
        const Vec3 beam = x[4];
        double height = -0.15;
        for (std::uint32_t s = world.groom().first_section[1] + 1; s + 1 < x.size(); ++s) {
            const Vec3 a = x[s] - beam, b = x[s + 1] - beam;
            if (a.z <= 0 && b.z > 0)
                height = double{(b.z * a.y - a.z * b.y) / (b.z - a.z)};
        }
        lowest = std::min(lowest, height);
    }
    return lowest;
}

} // namespace

TEST_CASE("M12: a section squeezed to half on one axis swells by a tenth on the other") {
    reference::SingleWisp without;
    without.ring_stiffness = without.ring_damping = 0;
    const double on = swelling({}), off = swelling(without);
    MESSAGE("swells by " << 100 * on << " %; without ring springs by " << 100 * off << " %");
    CHECK(on >= 0.1);
    CHECK(std::abs(off) < 1e-3);
}

TEST_CASE("M13: a wisp pressed on one side is pushed away") {
    const double on = backing_off({}), off = backing_off({.reaction = false});
    MESSAGE("backs off by " << on << " radii; without the springs' reaction by " << off);
    CHECK(on > 0.1);
    CHECK(std::abs(off) < 1e-3);
}

TEST_CASE("M36: a wisp that falls across another stays on it where contacts are found at 24 Hz") {
    const double on = lowest_crossing(true), off = lowest_crossing(false);
    MESSAGE("lowest at " << 1000 * on << " mm over the other's axis; answered only when found "
                         << 1000 * off << " mm");
    CHECK(on > 0.005); // two radii of 15 mm, pressed together
    CHECK(off < -0.02);
}
