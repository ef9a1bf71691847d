/// What a World tells of its contacts.

#include "step/lone_wisp.h"

#include <doctest/doctest.h>

using namespace mane;

namespace {

/// A slab 2 m wide whose top is at y = `top`.
Body floor_at(float top) {
    Body slab = {};
    for (float y : {top - 0.1f, top})
        for (float z : {-1.f, 1.f})
            for (float x : {-1.f, 1.f})
                slab.mesh.vertices.push_back({x, y, z});
    slab.mesh.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                           {1, 5, 7}, {1, 7, 3}, {3, 7, 6}, {3, 6, 2}, {2, 6, 4}, {2, 4, 0}};
    return slab;
}

/// Sticks out sideways and bends easily.
LoneWisp lying_wisp() {
    LoneWisp lone;
    lone.shape.direction = {1, 0, 0};
    lone.shape.length = 0.3f;
    lone.shape.radius = {0.01f, 0.01f};
    lone.shape.skeleton.bending_length = 0.08f;
    return lone;
}

/// Wisps of 2 cm radius side by side, so far along x [m].
Groom wide_wisps(const Mesh& peg, const std::vector<float>& along) {
    std::vector<WispDesign> wisps;
    for (const float x : along) {
        StraightWisp shape;
        shape.depth = 0.06f;
        shape.radius = {0.02f, 0.02f};
        wisps.push_back(design(shape, peg));
        for (Vec3& p : wisps.back().position)
            p.x += x;
    }
    return make_groom(wisps, peg);
}

} // namespace

TEST_CASE("what a floor pushes back is the weight that lies on it") {
    // The springs carry the wisp in its design under g, and it bends easily, so under 2 g it comes
    // down 2 mm to the floor, which carries the other g.
    LoneWisp lone = lying_wisp();
    lone.desc.gravity = {0, -2 * 9.80665f, 0};
    lone.desc.schedule.frame_rate = 120;
    lone.desc.schedule.integration_rate = 2000;
    const Groom groom = lone.groom();
    World world(lone.desc, groom,
                {make_peg(0.02f), floor_at(groom.position[1].y - 0.01f - 0.006f)});
    CHECK(world.contacts().empty());
    for (int i = 0; i < 480; ++i)
        world.advance();

    double weight = 0, carried = 0;
    for (std::size_t s = 3; s < groom.section_count(); ++s) // the root holds part of section 2
        weight += 9.80665 * (groom.skeleton_mass[s] + 4 * groom.envelope_mass[s]);
    const double dt = 1.0 / 120 / 17; // 2000 Hz, a whole number of steps in a frame
    double sideways = 0;
    for (const Contact& c : world.contacts()) {
        CHECK(c.kind == ContactKind::sliding);
        CHECK(c.body == 1);
        CHECK(c.section < groom.section_count());
        carried += c.impulse.y / dt;
        sideways += std::fabs(c.impulse.x) + std::fabs(c.impulse.z);
    }
    // Of section 2 at most half hangs on the root; the bend that is left carries some of the rest.
    CHECK(carried > 0.9 * weight);
    CHECK(carried < 1.25 * weight);
    CHECK(sideways / dt < 0.05 * weight); // it has all but come to rest
}

TEST_CASE("contacts of wisps are told with their kinds, and only where wisps touch") {
    const Mesh peg = make_peg(0.02f).mesh;
    SimulationDesc desc;
    const Groom groom = wide_wisps(peg, {0, 0.015f, 0.3f}); // two neighbours, one apart
    World world(desc, groom, {make_peg(0.02f)});
    world.advance();
    const std::vector<Contact> contacts = world.contacts();
    CHECK_FALSE(contacts.empty());
    const auto wisp_of = [&](std::uint32_t section) {
        return std::upper_bound(world.groom().first_section.begin(),
                                world.groom().first_section.end(), section) -
               world.groom().first_section.begin() - 1;
    };
    for (const Contact& c : contacts) {
        CHECK(c.kind == ContactKind::friction); // parallel wisps
        CHECK(wisp_of(c.section) + wisp_of(c.other) == 1);
        CHECK(c.other_along >= 0);
        CHECK(c.other_along <= 1);
    }
    CHECK(std::string(contact_kind_name(contacts[0].kind)) == "friction");
}

TEST_CASE("intersections are counted once per frame, whatever the rates") {
    const Mesh peg = make_peg(0.02f).mesh;
    const Groom groom = wide_wisps(peg, {0, 0.015f});
    for (const float rate : {24.f, 120.f, 1000.f}) {
        SimulationDesc desc;
        desc.gravity = {}; // nothing moves
        desc.schedule.frame_rate = 24;
        desc.schedule.wisp_rate = rate;
        desc.schedule.character_rate = std::max(rate, 120.f);
        World world(desc, groom, {make_peg(0.02f)});
        world.advance();
        const std::uint64_t once = world.statistics().intersections;
        CHECK(once > 0);
        world.advance();
        CHECK(world.statistics().intersections == 2 * once);
        CHECK(world.statistics().intersection_counts == 2);
        CHECK(world.statistics().wisp_detections == 2 * (rate < 100 ? 1 : rate < 200 ? 5 : 42));
    }
}

TEST_CASE("penetration reactions are told one by one: which point, out of which body, by how far") {
    // Contacts that are answered only when they are found: between two detections the wisp falls
    // into the floor.
    LoneWisp lone = lying_wisp();
    lone.desc.gravity = {0, -20 * 9.80665f, 0};
    lone.desc.schedule.frame_rate = 60;
    lone.desc.schedule.integration_rate = 2000;
    lone.desc.schedule.hold_contacts = false;
    const Groom groom = lone.groom();
    const float top = groom.position[1].y - 0.02f;
    World world(lone.desc, groom, {make_peg(0.02f), floor_at(top)});
    CHECK(world.reactions().empty());

    std::uint64_t before = 0;
    bool skeleton = false, envelope = false;
    for (int i = 0; i < 12; ++i) {
        world.advance();
        const std::uint64_t counted = world.statistics().penetration_reactions;
        CHECK(world.reactions().size() == counted - before);
        before = counted;
        for (const Reaction& r : world.reactions()) {
            CHECK(r.body == 1);
            CHECK(r.triangle < 12);
            CHECK(r.section >= 2);
            CHECK(r.section < groom.section_count());
            CHECK(r.point <= groom.envelope_points);
            CHECK(r.shift.y > 0); // up, out of the floor
            CHECK(r.shift.y < 0.02f);
            (r.point == 0 ? skeleton : envelope) = true;
        }
    }
    CHECK(skeleton);
    CHECK(envelope);
}
