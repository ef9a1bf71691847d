/// Pinned sections in contact (M46): they answer to nothing, all else answers to them.

#include "interactions/wisp_response.h"
#include "reference/random_contacts.h"
#include "reference/random_groom.h"
#include "reference/random_numbers.h"
#include "step/core_hair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace mane;

namespace {

/// Random hair of which some sections are held, still, as the head's are.
struct HeldHair {
    reference::RandomHair recipe;
    Groom groom;
    CoreHair core;
    reference::Hair twin;
    std::set<std::uint32_t> held;

    HeldHair(const reference::RandomHair& recipe_, double held_share)
        : recipe(recipe_), groom(random_groom(recipe)), core(groom), twin(groom) {
        const Frame frame = random_state(recipe, groom, recipe.seed);
        set_state(twin, frame);
        core.take(frame);
        core.take(all_frames(twin));
        reference::RandomNumbers random(recipe.seed);
        for (std::uint32_t s = 0; s < groom.section_count(); ++s)
            if (!core.layout.simulated(s) || random.between(0, 1) < held_share)
                hold(s, {});
        take_motion();
    }
    void hold(std::uint32_t s, const Vec3& velocity) {
        core.state.velocity.set(core.layout.slot(s), velocity);
        if (!core.layout.simulated(s))
            return;
        core.rest.hold(core.layout.slot(s));
        held.insert(s);
    }
    /// The twin moves as the core does.
    void take_motion() {
        for (std::size_t w = 0; w < groom.wisp_count(); ++w)
            for (std::size_t i = 0; i < groom.sections(w); ++i) {
                const Slot slot = core.slot(w, i);
                twin.wisps[w].v[i] = Vec3d(core.state.velocity.vec(slot));
                for (std::uint32_t k = 0; k < groom.envelope_points; ++k)
                    twin.wisps[w].r_rate[i][k] = double{core.state.radius_rate.at(slot, k)};
            }
    }
    double kinetic_energy() const {
        double sum = 0;
        for (const reference::Wisp& wisp : twin.wisps)
            sum += energy(wisp, {}).kinetic;
        return sum;
    }
    void respond(const std::vector<reference::Contact>& contacts) {
        ContactGeometry geometry;
        WispResponse response({});
        Threads threads(1);
        geometry.take(core.view(), threads);
        const ContactList list = contact_list(geometry.points().order, core.take(contacts));
        response.engage(core.view(), geometry, list, threads);
        response.prepare(geometry, 1.0f / 120, threads);
        response.apply(core.view(), geometry, core.state, threads);
        take_motion();
    }
};

} // namespace

TEST_CASE("kinetic energy never rises where sections are held still, and they stay still") {
    double most_lost = 0;
    std::size_t held = 0;
    for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
        HeldHair hair({.seed = seed,
                       .wisps = static_cast<std::uint32_t>(1 + seed % 4),
                       .points = static_cast<std::uint32_t>(3 + seed % 6),
                       .most_sections = 7},
                      0.5);
        const auto contacts = random_contacts(hair.twin, 1 + seed % 40, seed);
        const double before = hair.kinetic_energy();
        hair.respond(contacts);
        const double after = hair.kinetic_energy();
        REQUIRE(std::isfinite(after));
        CHECK(after <= before * (1 + 1e-5)); // velocities are floats
        most_lost = std::max(most_lost, before > 0 ? 1 - after / before : 0);
        for (const std::uint32_t s : hair.held)
            CHECK(hair.core.state.velocity.vec(hair.core.layout.slot(s)) == Vec3());
        held += hair.held.size();
    }
    CHECK(held > 3000);
    CHECK(most_lost > 0.5);
}

TEST_CASE(
    "a section that meets a held wisp moves on as that one does, and the held one is not moved") {
    HeldHair hair({.seed = 2, .wisps = 2, .least_sections = 5, .most_sections = 7}, 0);
    const std::uint32_t first = hair.groom.first_section[0] + 3,
                        second = hair.groom.first_section[1];
    for (std::uint32_t s = second; s < hair.groom.section_count(); ++s)
        hair.hold(s, {0, 0, 0.5f});
    hair.core.state.velocity.set(hair.core.layout.slot(first), {1, 2, 3});
    hair.take_motion();
    reference::Contact contact;
    contact.point = {0, 3};
    contact.segment = {1, 2};
    contact.s = 0.4;
    hair.respond({contact});
    // a collision: the relative velocity goes, and all of it is the free one's to lose
    const Vec3 v = hair.core.state.velocity.vec(hair.core.layout.slot(first));
    CHECK(length(v - Vec3(0, 0, 0.5f)) < 1e-5f);
    for (std::uint32_t s = second; s < hair.groom.section_count(); ++s)
        CHECK(hair.core.state.velocity.vec(hair.core.layout.slot(s)) == Vec3(0, 0, 0.5f));
}
