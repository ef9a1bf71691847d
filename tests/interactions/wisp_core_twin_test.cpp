/// Contacts between wisps: the core against the twin. Lists and answers are compared apart: in
/// float a point on the surface falls in or out by its last bit, so the answers are compared on the
/// same list (M21–M28).

#include "interactions/literal_response.h"
#include "interactions/wisp_detection.h"
#include "interactions/wisp_response.h"
#include "reference/random_contacts.h"
#include "reference/random_groom.h"
#include "step/core_hair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

using namespace mane;
using reference::Contact;

namespace {

/// The same random hair for both.
struct Both {
    Groom groom;
    Frame frame;
    reference::Hair twin;
    CoreHair core;

    explicit Both(const reference::RandomHair& recipe)
        : groom(random_groom(recipe)), frame(random_state(recipe, groom, 1)), twin(groom),
          core(groom) {
        set_state(twin, frame);
        core.take(frame);
        core.take(all_frames(twin));
    }
};

using Place = std::tuple<std::uint32_t, std::uint8_t, std::uint32_t>;
std::map<Place, WispContact> by_place(std::span<const WispContact> contacts) {
    std::map<Place, WispContact> map;
    for (const WispContact& c : contacts)
        map[{c.section, c.point.code, c.segment}] = c;
    return map;
}

void respond(CoreHair& core, const std::vector<WispContact>& contacts, const WispContactDesc& desc,
             float time) {
    if (desc.literal) {
        respond_literally(core.view(), contacts, desc, time, core.state);
        return;
    }
    ContactGeometry geometry;
    WispResponse response(desc);
    Threads threads(1);
    geometry.take(core.view(), threads);
    const ContactList list = contact_list(geometry.points().order, contacts);
    response.engage(core.view(), geometry, list, threads);
    response.prepare(geometry, time, threads);
    response.apply(core.view(), geometry, core.state, threads);
}

/// Of any velocity or rate, relative to 1 m/s and itself.
double largest_difference(const Both& both) {
    double largest = 0;
    for (std::size_t w = 0; w < both.groom.wisp_count(); ++w)
        for (std::size_t i = 0; i < both.groom.sections(w); ++i) {
            const Slot slot = both.core.slot(w, i);
            const reference::Wisp& twin = both.twin.wisps[w];
            const Vec3d v(both.core.state.velocity.vec(slot));
            largest = std::max(largest, length(v - twin.v[i]) / (1 + length(twin.v[i])));
            for (std::uint32_t k = 0; k < both.groom.envelope_points; ++k) {
                const double rate = double{both.core.state.radius_rate.at(slot, k)},
                             expected = twin.r_rate[i][k];
                largest = std::max(largest, std::fabs(rate - expected) / (1 + std::fabs(expected)));
            }
        }
    return largest;
}

int sections_changed(const reference::Hair& before, const reference::Hair& after) {
    int count = 0;
    for (std::size_t w = 0; w < before.wisps.size(); ++w)
        for (std::size_t i = 0; i < before.wisps[w].sections(); ++i)
            count += length(after.wisps[w].v[i] - before.wisps[w].v[i]) > 0.01;
    return count;
}

} // namespace

TEST_CASE("the core finds the contacts that comparing everything with everything finds") {
    std::size_t all = 0, axes = 0, friction = 0, missed = 0, other_kind = 0;
    double pairs_off = 0, pairs = 0;
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
        const Both both({.seed = seed,
                         .wisps = 20,
                         .points = static_cast<std::uint32_t>(3 + seed % 6),
                         .most_sections = 9,
                         .spread = 0.03});
        const reference::Detection expected = detect(both.twin, {});
        const std::vector<WispContact> expected_contacts = both.core.take(expected.contacts);

        ContactGeometry geometry;
        WispDetection detection({});
        Threads threads(1);
        geometry.take(both.core.view(), threads);
        detection.detect(both.core.view(), geometry.points(), threads);
        const auto found = by_place(detection.list().all(geometry.points().order)),
                   wanted = by_place(expected_contacts);
        REQUIRE(found.size() == detection.list().size()); // each place once
        for (const auto& [place, w] : wanted) {
            const auto f = found.find(place);
            all += 1;
            if (f == found.end()) {
                missed += 1;
                continue;
            }
            axes += w.point.is_axis();
            friction += w.kind == WispContactKind::friction;
            other_kind += w.kind != f->second.kind;
            CHECK(std::fabs(f->second.s - w.s) < 1e-3f);
            CHECK(std::fabs(f->second.along - w.along) < 1e-3f);
            CHECK(std::fabs(f->second.density - w.density) < 1e-3f * w.density);
            CHECK(std::fabs(f->second.weight - w.weight) < 1e-3f);
        }
        for (const auto& [place, f] : found)
            missed += !wanted.contains(place);
        pairs += static_cast<double>(expected.intersecting_pairs);
        pairs_off += std::fabs(static_cast<double>(detection.intersecting_pairs()) -
                               static_cast<double>(expected.intersecting_pairs));
    }
    MESSAGE(all << " contacts, " << axes << " of axes, " << friction << " quasi-parallel; "
                << missed << " found by one only, " << other_kind << " of another kind; " << pairs
                << " pairs, " << pairs_off << " off");
    CHECK(all > 2000);
    CHECK(axes > 100);
    CHECK(friction > 100);
    // Places have 24 bits: about one in ten thousand lies nearer to a limit than rounding carries
    // it.
    CHECK(missed <= all / 1000);
    CHECK(other_kind <= all / 1000);
    CHECK(pairs_off <= pairs / 1000);
}

TEST_CASE("the core answers a list of contacts as the twin does, by either rule") {
    for (const bool literal : {false, true}) {
        WispContactDesc desc;
        desc.literal = literal;
        double worst = 0;
        int changed = 0;
        for (std::uint64_t seed = 1; seed <= 200; ++seed) {
            Both both({.seed = seed,
                       .wisps = static_cast<std::uint32_t>(1 + seed % 33),
                       .points = static_cast<std::uint32_t>(3 + seed % 6),
                       .most_sections = 8});
            const std::vector<reference::Contact> contacts =
                random_contacts(both.twin, 1 + seed, seed);
            const float time = seed % 3 || literal ? 1.0f / 120 : 0.001f;
            desc.friction = seed % 5 ? WispContactDesc().friction : 0; // then the plane is all
            const reference::Hair before = both.twin;
            respond(both.twin, contacts, desc, double{time});
            respond(both.core, both.core.take(contacts), desc, time);
            worst = std::max(worst, largest_difference(both));
            changed += sections_changed(before, both.twin);
        }
        MESSAGE("largest difference " << worst);
        CHECK(changed > 1000);
        // Every velocity comes from sums over the contacts of its section, with masses that differ
        // up to fifty times: 24 bits less two digits, relative to what moves.
        CHECK(worst < 5e-5);
    }
}
