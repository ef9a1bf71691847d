/// M24–M28 on the twin: what an answer to contacts may and may not do, whatever the contacts.

#include "reference/random_contacts.h"
#include "reference/random_groom.h"
#include "reference/random_numbers.h"
#include "reference/single_wisp.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace mane;
using namespace mane::reference;

namespace {

/// Random hair whose head stands still.
Hair random_hair(std::uint64_t seed, std::uint32_t wisps, std::uint32_t most_sections) {
    const RandomHair recipe = {.seed = seed,
                               .wisps = wisps,
                               .points = static_cast<std::uint32_t>(3 + seed % 6),
                               .most_sections = most_sections};
    const Groom groom = random_groom(recipe);
    Hair hair(groom);
    set_state(hair, random_state(recipe, groom, seed));
    for (Wisp& wisp : hair.wisps)
        wisp.v[0] = wisp.v[1] = {};
    return hair;
}

double kinetic_energy(const Hair& hair) {
    double sum = 0;
    for (const Wisp& wisp : hair.wisps)
        sum += energy(wisp, {}).kinetic;
    return sum;
}

Vec3d momentum(const Hair& hair) {
    Vec3d sum;
    for (const Wisp& wisp : hair.wisps) {
        const std::vector<SectionFrame> frames = section_frames(wisp);
        for (std::size_t i = 2; i < wisp.sections(); ++i) {
            sum += wisp.skeleton_mass[i] * wisp.v[i];
            for (std::size_t k = 0; k < wisp.points(); ++k)
                sum += wisp.envelope_mass[i] *
                       (wisp.v[i] + wisp.r_rate[i][k] * half_line(frames[i], k, wisp.points()));
        }
    }
    return sum;
}

/// Sums over contacts differ by rounding with their order; nothing else may.
double largest_difference(const Hair& a, const Hair& b) {
    double largest = 0;
    for (std::size_t w = 0; w < a.wisps.size(); ++w)
        for (std::size_t i = 0; i < a.wisps[w].sections(); ++i) {
            largest = std::max(largest, length(a.wisps[w].v[i] - b.wisps[w].v[i]));
            for (std::size_t k = 0; k < a.wisps[w].points(); ++k)
                largest =
                    std::max(largest, std::abs(a.wisps[w].r_rate[i][k] - b.wisps[w].r_rate[i][k]));
        }
    return largest;
}

/// Two wisps that cross, and the contact of the first one's section 3 with the second one's section
/// 3 (at s = 0 of the segment that begins there).
struct Pair {
    Hair hair{Groom{}};
    Contact contact;

    explicit Pair(double angle) {
        SingleWisp first, second;
        first.segments = second.segments = 4;
        second.direction = {std::sin(angle), -std::cos(angle), 0};
        second.across = {0, 0, 1};
        hair.wisps = {first.wisp(), second.wisp()};
        contact.point = {0, 3};
        contact.segment = {1, 3};
    }
    Wisp& first() { return hair.wisps[0]; }
    Wisp& second() { return hair.wisps[1]; }
    /// Sections without envelope mass have the same inertia in all directions.
    void make_isotropic() {
        for (Wisp& wisp : hair.wisps)
            std::fill(wisp.envelope_mass.begin(), wisp.envelope_mass.end(), 0.0);
    }
};

} // namespace

TEST_CASE("kinetic energy never rises: any masses, K, states and contacts, kinematic points "
          "included") {
    double most_lost = 0;
    for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
        Hair hair = random_hair(seed, 1 + seed % 4, 6);
        const auto contacts = random_contacts(hair, 1 + seed % 40, seed);
        const double before = kinetic_energy(hair);
        respond(hair, contacts, {}, seed % 3 == 0 ? 0 : 1.0 / 120);
        const double after = kinetic_energy(hair);
        CHECK(after <= before * (1 + 1e-13));
        most_lost = std::max(most_lost, 1 - after / before);
    }
    CHECK(most_lost > 0.5);
}

TEST_CASE("kinetic energy in the frame of a moving head never rises") {
    const Vec3d head = {3, -1, 2};
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Hair still = random_hair(seed, 3, 6), moving = still;
        for (Wisp& wisp : moving.wisps)
            for (Vec3d& v : wisp.v)
                v += head;
        const auto contacts = random_contacts(still, 20, seed);
        respond(still, contacts, {}, 1.0 / 120);
        respond(moving, contacts, {}, 1.0 / 120);
        for (Wisp& wisp : moving.wisps)
            for (Vec3d& v : wisp.v)
                v -= head;
        CHECK(largest_difference(still, moving) < 1e-12); // the answer is Galilean
    }
}

TEST_CASE("momentum is kept where nothing is kinematic") {
    for (std::uint64_t seed = 1; seed <= 500; ++seed) {
        Hair hair = random_hair(seed, 3, 8);
        std::vector<Contact> contacts = random_contacts(hair, 40, seed);
        std::erase_if(contacts, [](const Contact& c) {
            return c.point.section < 2 || c.segment.section < 2;
        });
        const Vec3d before = momentum(hair);
        const Hair unanswered = hair;
        respond(hair, contacts, {}, 1.0 / 120);
        CHECK((contacts.empty() || largest_difference(hair, unanswered) > 1e-6));
        CHECK(length(momentum(hair) - before) < 1e-13 * (length(before) + 1e-3));
    }
}

TEST_CASE("the order of contacts does not matter") {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        Hair hair = random_hair(seed, 3, 6), other = hair;
        std::vector<Contact> contacts = random_contacts(hair, 40, seed);
        respond(hair, contacts, {}, 1.0 / 120);
        RandomNumbers random(seed);
        for (std::size_t i = contacts.size(); i > 1; --i)
            std::swap(contacts[i - 1],
                      contacts[random.count(0, static_cast<std::uint32_t>(i - 1))]);
        respond(other, contacts, {}, 1.0 / 120);
        CHECK(largest_difference(hair, other) < 1e-12);
    }
}

TEST_CASE("a lone collision takes its weight's share of the relative velocity, all of it well "
          "inside; next to the root some of it") {
    int equal = 0, nearer = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        Hair hair = random_hair(seed, 3, 6);
        std::vector<Contact> contacts = random_contacts(hair, 1, seed);
        if (contacts.empty() || (contacts[0].point.section < 2 && contacts[0].segment.section < 2))
            continue;
        contacts[0].friction = false;
        const auto relative_speed = [&] {
            return length(point_side(hair, all_frames(hair), contacts[0]).velocity -
                          segment_side(hair, contacts[0]).velocity);
        };
        const double before = relative_speed();
        respond(hair, contacts, {}, 0);
        const bool held = contacts[0].segment.section < 2 ||
                          (contacts[0].k == Contact::kAxis && contacts[0].point.section < 2);
        if (held)
            CHECK(relative_speed() < before);
        else
            CHECK(std::abs(relative_speed() - (1 - contacts[0].weight) * before) < 1e-12);
        ++(held ? nearer : equal);
    }
    CHECK(equal > 50);
    CHECK(nearer > 10);
}

TEST_CASE("a head-on collision of two equal points gives the average of their velocities") {
    Pair pair(1.2);
    pair.make_isotropic();
    pair.first().v[3] = {1, 2, 3};
    pair.second().v[3] = {-3, 0, 1};
    respond(pair.hair, {pair.contact}, {}, 0);
    CHECK(length(pair.first().v[3] - Vec3d{-1, 1, 2}) < 1e-14);
    CHECK(length(pair.second().v[3] - Vec3d{-1, 1, 2}) < 1e-14);
}

TEST_CASE("two contacts of the same two points give the same average: masses are shared") {
    Pair pair(1.2);
    pair.make_isotropic();
    pair.first().v[3] = {1, 2, 3};
    pair.second().v[3] = {-3, 0, 1};
    respond(pair.hair, {pair.contact, pair.contact, pair.contact}, {}, 0);
    CHECK(length(pair.first().v[3] - Vec3d{-1, 1, 2}) < 1e-14);
    CHECK(length(pair.second().v[3] - Vec3d{-1, 1, 2}) < 1e-14);
}

TEST_CASE("an envelope point takes an impulse along its half line, its skeleton point the rest") {
    Pair pair(1.2);
    pair.contact.k = 1;
    const Vec3d d = half_line(section_frames(pair.first())[3], 1, 4);
    const double M = pair.first().skeleton_mass[3], m = pair.first().envelope_mass[3];

    pair.second().skeleton_mass.assign(6, 1e9); // a wall
    Hair along = pair.hair, across = pair.hair;
    along.wisps[0].v[3] = 2.0 * d;
    respond(along, {pair.contact}, {}, 0);
    CHECK(length(along.wisps[0].v[3] - 2.0 * d) < 1e-8); // nothing but the envelope point stops
    CHECK(along.wisps[0].r_rate[3][1] == doctest::Approx(-2));
    CHECK(std::abs(along.wisps[0].r_rate[3][3]) < 1e-8);

    const Vec3d n = section_frames(pair.first())[3].n, side = cross(n, d);
    across.wisps[0].v[3] = side;
    respond(across, {pair.contact}, {}, 0);
    // The whole skeleton point stops; the two envelope points on the lines along `side` move on.
    CHECK(length(across.wisps[0].v[3]) < 1e-8);
    CHECK(std::abs(across.wisps[0].r_rate[3][1]) < 1e-8);
    CHECK(std::abs(across.wisps[0].r_rate[3][0]) == doctest::Approx(1));
    CHECK(energy(across.wisps[0], {}).kinetic == doctest::Approx(2 * m / 2));
    CHECK(energy(pair.first(), {}).kinetic == 0);
    CHECK(M > 4 * m);
}

TEST_CASE("aligned wisps drag each other as e^(−cρΔt), in all directions") {
    for (const double density : {0.5, 1.0, 4.0})
        for (const double time : {1e-3, 1.0 / 120, 0.2}) {
            Pair pair(0);
            pair.make_isotropic();
            pair.contact.friction = true;
            pair.contact.density = density;
            pair.first().v[3] = {0.5, 2, -1};
            WispContactDesc desc;
            desc.friction = 10;
            respond(pair.hair, {pair.contact}, desc, time);
            const Vec3d relative = pair.first().v[3] - pair.second().v[3];
            const Vec3d expected = std::exp(-10 * density * time) * Vec3d{0.5, 2, -1};
            CHECK(length(relative - expected) < 1e-13);
        }
}

TEST_CASE("quasi-parallel wisps keep nothing of the velocity across their plane, and drag in it") {
    Pair pair(20 * std::numbers::pi / 180); // over the fade angle, in the plane z = 0
    pair.make_isotropic();
    pair.contact.friction = true;
    pair.first().v[3] = {0.5, 2, -1};
    respond(pair.hair, {pair.contact}, {}, 0.01);
    const Vec3d relative = pair.first().v[3] - pair.second().v[3];
    const double drag = std::exp(-10 * 0.01);
    CHECK(length(relative - Vec3d{0.5 * drag, 2 * drag, 0}) < 1e-13);
}

TEST_CASE("quasi-parallel contacts do nothing in no time") {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Hair hair = random_hair(seed, 3, 6);
        std::vector<Contact> contacts = random_contacts(hair, 20, seed);
        for (Contact& contact : contacts)
            contact.friction = true;
        const Hair before = hair;
        respond(hair, contacts, {}, 0);
        CHECK(largest_difference(hair, before) == 0);
    }
}

TEST_CASE("the rule as printed: half for each contact, added, fading with the bare product") {
    WispContactDesc literal;
    literal.literal = true;
    Pair collision(1.2);
    collision.first().v[3] = {1, 2, 3};
    collision.second().v[3] = {-3, 0, 1};
    Pair twice = collision;
    respond(collision.hair, {collision.contact}, literal, 0);
    CHECK(length(collision.first().v[3] - Vec3d{-1, 1, 2}) < 1e-14);
    CHECK(collision.second().v[3] == Vec3d{-3, 0, 1}); // its own contact answers for it

    respond(twice.hair, {twice.contact, twice.contact, twice.contact, twice.contact}, literal, 0);
    CHECK(length(twice.first().v[3] - Vec3d{-7, -2, -1}) < 1e-14); // thrown back: energy grows

    const double angle = 0.3;
    Pair sliding(angle);
    sliding.contact.friction = true;
    sliding.first().v[3] = {0.5, 2, -1};
    respond(sliding.hair, {sliding.contact}, literal, 0.01);
    const double kept = 1 - std::sin(angle) * std::sin(angle) / 2, drag = 1 - 10 * 0.01;
    CHECK(length(sliding.first().v[3] - Vec3d{0.5 * drag, 2 * drag, -kept}) < 1e-7);
}
