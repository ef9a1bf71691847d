#include "step/twin_world.h"

#include "step/core_contacts.h"
#include "step/placement.h"
#include "step/roots.h"

#include <chrono>

namespace mane {

TwinWorld::TwinWorld(const SimulationDesc& desc, const Groom& groom, std::vector<Body> bodies)
    : core_(desc, groom, {}), cast_(std::move(bodies)), hair_(groom) {
    core_.origin = cast_.on_head(Vec3d(groom.position[1]), 0);
    core_.bodies = cast_.contact_bodies();
    cast_.begin(0, core_.origin);
    place_groom(core_, cast_, 0);
    std::uint32_t section = 0;
    for (reference::Wisp& wisp : hair_.wisps)
        for (std::size_t i = 0; i < wisp.sections(); ++i, ++section) {
            const Slot slot = core_.layout.slot(section);
            wisp.x[i] = Vec3d(core_.state.position.vec(slot));
            wisp.v[i] = Vec3d(core_.state.velocity.vec(slot));
        }
}

void TwinWorld::advance() {
    const Schedule& schedule = core_.schedule;
    const auto time = [&](std::uint64_t step) {
        return static_cast<double>(frames_ * schedule.steps() + step) * schedule.step_seconds();
    };
    for (std::uint32_t b = 0; b < schedule.blocks(); ++b) {
        const std::uint32_t begin = schedule.block_begin(b), end = schedule.block_begin(b + 1);
        enter_block(time(begin), (end - begin) * schedule.step_seconds());
        detect(schedule.detects_wisps(b));
        StepPlace place{
            .index = 0, .steps = end - begin, .detects_wisps = schedule.detects_wisps(b)};
        for (; place.index < place.steps; ++place.index)
            step(place, time(begin + place.index));
        react();
    }
    ++frames_;
}

void TwinWorld::enter_block(double time, double seconds) {
    const auto follow = [&](int end) {
        follow_scalp(core_.groom, core_.layout, cast_.body(0).mesh, cast_.vertices(0),
                     cast_.velocities(0), end, core_.roots);
    };
    core_.roots.seconds = static_cast<float>(seconds);
    follow(0);
    cast_.advance(time + seconds, seconds, core_.origin);
    follow(1);
}

void TwinWorld::detect(bool wisps) {
    roots_at(0);
    write_state();
    if (wisps && core_.desc.wisps.mode != WispContactMode::off) {
        core_.contact_geometry.take(core_.hair(), core_.threads);
        core_.wisp_detection.detect(core_.hair(), core_.contact_geometry.points(), core_.threads);
        contacts_ =
            contacts_of(core_.wisp_detection.list().all(core_.contact_geometry.points().order),
                        core_.groom, core_.layout);
        for (const reference::Contact& c : contacts_)
            ++(c.friction ? core_.statistics.friction_contacts
                          : core_.statistics.collision_contacts);
    }
    core_.character_contacts.detect(core_.hair(), core_.bodies, core_.desc.character,
                                    core_.threads);
    core_.statistics.sliding_contacts += core_.character_contacts.count();
}

void TwinWorld::step(const StepPlace& place, double time) {
    reference::HairStep input;
    input.start = roots_at(place.begin());
    input.end = roots_at(place.end());
    input.surroundings = {.gravity = Vec3d(core_.desc.gravity),
                          .air_drag = double{core_.desc.air.drag}};
    input.h = core_.schedule.step_seconds();
    input.contacts = contacts_;
    input.friction_time = core_.schedule.step_seconds();
    input.wisps = core_.desc.wisps;
    for (std::size_t w = 0; w < hair_.wisps.size(); ++w)
        input.planes.push_back(planes_of(core_.character_contacts.of_wisp(w), double{place.begin()},
                                         double{core_.roots.seconds}));
    input.character = core_.desc.character;
    if (place.first()) { // the wind is felt once a block
        const std::vector<Vec3d> air = air_at(time);
        std::size_t section = 0;
        for (reference::Wisp& wisp : hair_.wisps)
            for (Vec3d& a : wisp.air)
                a = air[section++];
    }
    const auto start = std::chrono::steady_clock::now();
    reference::step(hair_, input);
    step_seconds_ +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Sections that the core's penetration reaction moves, the twin puts at the same place; the others
/// keep their own digits.
void TwinWorld::react() {
    write_state();
    const State before = core_.state;
    core_.statistics.penetration_reactions += core_.character_contacts.react(
        core_.hair(), core_.bodies, core_.desc.character, core_.state, core_.threads);
    std::uint32_t section = 0;
    for (reference::Wisp& wisp : hair_.wisps)
        for (std::size_t i = 0; i < wisp.sections(); ++i, ++section) {
            const Slot slot = core_.layout.slot(section);
            reference::Shift shift{i, wisp.x[i], wisp.r[i]};
            const Vec3 x = core_.state.position.vec(slot);
            if (x != before.position.vec(slot))
                shift.position = Vec3d(x);
            for (std::uint32_t k = 0; k < wisp.points(); ++k)
                if (const float r = core_.state.radius.at(slot, k); r != before.radius.at(slot, k))
                    shift.radii[k] = double{r};
            reference::shift(wisp, {shift});
        }
}

/// The twin's state and its frames, as the core's detection reads them.
void TwinWorld::write_state() {
    std::uint32_t section = 0;
    for (const reference::Wisp& wisp : hair_.wisps) {
        const std::vector<reference::SectionFrame> frames = section_frames(wisp);
        for (std::size_t i = 0; i < wisp.sections(); ++i, ++section) {
            const Slot slot = core_.layout.slot(section);
            core_.state.position.set(slot, Vec3(wisp.x[i]));
            core_.state.velocity.set(slot, Vec3(wisp.v[i]));
            for (std::uint32_t k = 0; k < wisp.points(); ++k) {
                core_.state.radius.at(slot, k) = static_cast<float>(wisp.r[i][k]);
                core_.state.radius_rate.at(slot, k) = static_cast<float>(wisp.r_rate[i][k]);
            }
            core_.frames.u.set(slot, Vec3(frames[i].u));
            core_.frames.v.set(slot, Vec3(frames[i].v));
            core_.frames.normal.set(slot, Vec3(frames[i].n));
        }
    }
}

/// Where the head holds the wisps at `s` of the block. Puts the twin's kinematic sections there at
/// the block's beginning.
std::vector<reference::Root> TwinWorld::roots_at(float s) {
    const KernelData data = core_.kernel_data();
    const std::size_t packets = core_.layout.packets().size();
    core_.kernels.place_roots(data, s, 0, packets);
    core_.kernels.move_root_velocities(data, s, 0, packets);
    std::vector<reference::Root> roots(hair_.wisps.size());
    for (std::uint32_t p = 0; p < packets; ++p)
        for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
            const std::uint32_t w = core_.layout.packets()[p].wisp[lane];
            if (w == Layout::kNoWisp)
                continue;
            const std::uint32_t first = core_.groom.first_section[w];
            const Slot inside = core_.layout.slot(first), outside = core_.layout.slot(first + 1);
            const State& state = core_.state;
            roots[w] = {Vec3d(state.position.vec(inside)), Vec3d(state.position.vec(outside)),
                        Vec3d(state.velocity.vec(inside)), Vec3d(state.velocity.vec(outside)),
                        Vec3d(core_.root_axis.vec({p, lane}))};
            if (s == 0) {
                set_root_position(hair_.wisps[w], roots[w]);
                set_root_velocity(hair_.wisps[w], roots[w]);
            }
        }
    return roots;
}

std::vector<Vec3d> TwinWorld::air_at(double time) const {
    std::vector<Vec3d> air;
    for (const reference::Wisp& wisp : hair_.wisps)
        for (const Vec3d& x : wisp.x)
            air.push_back(core_.air.is_uniform()
                              ? Vec3d(core_.air.mean())
                              : Vec3d(core_.air.velocity(core_.origin + x, time)));
    return air;
}

} // namespace mane
