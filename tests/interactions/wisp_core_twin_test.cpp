/// Contacts between wisps: the core against the twin. Lists and answers are compared apart: in
/// float a point on the surface falls in or out by its last bit, so the answers are compared on the
/// same list (M21–M28).

#include "interactions/wisp_detection.h"
#include "interactions/wisp_response.h"
#include "reference/random_contacts.h"
#include "reference/random_groom.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

using namespace mane;
using reference::Contact;

namespace {

/// The core's view of the same hair, with the twin's frames.
struct Core {
    Groom groom;
    Layout layout;
    RestRows rest;
    std::vector<HalfLine> lines;
    State state;
    SectionFrames frames;

    Core(const Groom& g, const Frame& frame, const reference::Hair& twin)
        : groom(g), layout(groom), rest(groom, layout), lines(half_lines(groom.envelope_points)),
          state(layout.rows(), groom.envelope_points), frames(layout.rows()) {
        const std::uint32_t k = groom.envelope_points;
        const reference::Frames axes = all_frames(twin);
        for (std::uint32_t w = 0; w < groom.wisp_count(); ++w)
            for (std::uint32_t i = 0; i < groom.sections(w); ++i) {
                const std::uint32_t s = groom.first_section[w] + i;
                const Slot slot = layout.slot(s);
                state.position.set(slot, frame.position[s]);
                state.velocity.set(slot, frame.velocity[s]);
                for (std::uint32_t e = 0; e < k; ++e) {
                    state.radius.at(slot, e) = frame.radius[s * k + e];
                    state.radius_rate.at(slot, e) = frame.radius_rate[s * k + e];
                }
                frames.u.set(slot, Vec3(axes[w][i].u));
                frames.v.set(slot, Vec3(axes[w][i].v));
                frames.normal.set(slot, Vec3(axes[w][i].n));
            }
    }
    HairView view() const { return {groom, layout, rest, state, frames, lines}; }

    std::uint32_t section(const reference::Site& site) const {
        return groom.first_section[site.wisp] + static_cast<std::uint32_t>(site.section);
    }
    WispContact contact(const Contact& c) const {
        WispContact out;
        out.section = section(c.point);
        if (c.k == Contact::kAxis)
            out.point = {ContactPoint::kAxis};
        else if (c.k >= 0)
            out.point = ContactPoint::envelope(static_cast<std::uint32_t>(c.k));
        out.kind = c.friction ? WispContactKind::friction : WispContactKind::collision;
        out.segment = section(c.segment);
        out.s = static_cast<float>(c.s);
        out.along = static_cast<float>(c.along);
        out.density = static_cast<float>(c.density);
        return out;
    }
};

/// The same random hair for both.
struct Both {
    Groom groom;
    Frame frame;
    reference::Hair twin;
    Core core;

    explicit Both(const reference::RandomHair& recipe)
        : groom(random_groom(recipe)), frame(random_state(recipe, groom, 1)), twin(posed()),
          core(groom, frame, twin) {}

  private:
    reference::Hair posed() const {
        reference::Hair hair(groom);
        set_state(hair, frame);
        return hair;
    }
};

using Place = std::tuple<std::uint32_t, std::uint8_t, std::uint32_t>;
std::map<Place, WispContact> by_place(std::span<const WispContact> contacts) {
    std::map<Place, WispContact> map;
    for (const WispContact& c : contacts)
        map[{c.section, c.point.code, c.segment}] = c;
    return map;
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
        std::vector<WispContact> expected_contacts;
        for (const Contact& c : expected.contacts)
            expected_contacts.push_back(both.core.contact(c));

        WispDetection detection({});
        Threads threads(1);
        detection.detect(both.core.view(), threads);
        CHECK(std::is_sorted(detection.contacts().begin(), detection.contacts().end(), before));
        const auto found = by_place(detection.contacts()), wanted = by_place(expected_contacts);
        REQUIRE(found.size() == detection.contacts().size()); // each place once
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

TEST_CASE("the core answers a list of contacts as the twin does") {
    double worst = 0;
    int changed = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Both both({.seed = seed,
                   .wisps = static_cast<std::uint32_t>(1 + seed % 33),
                   .points = static_cast<std::uint32_t>(3 + seed % 6),
                   .most_sections = 8});
        const std::vector<Contact> contacts = random_contacts(both.twin, 1 + seed, seed);
        std::vector<WispContact> core_contacts;
        for (const Contact& c : contacts)
            core_contacts.push_back(both.core.contact(c));
        const float time = seed % 3 ? 1.0f / 120 : 0.0f;

        const reference::Hair before = both.twin;
        respond(both.twin, contacts, {}, double{time});
        WispResponse response({});
        Threads threads(1);
        response.engage(both.core.view(), core_contacts);
        response.apply(both.core.view(), both.core.state, time, threads);

        // Every velocity comes from sums over the contacts of its section, with masses that differ
        // up to fifty times: 24 bits less two digits, relative to what moves.
        for (std::uint32_t w = 0; w < both.groom.wisp_count(); ++w)
            for (std::uint32_t i = 0; i < both.groom.sections(w); ++i) {
                const Slot slot = both.core.layout.slot(both.groom.first_section[w] + i);
                const reference::Wisp& twin = both.twin.wisps[w];
                const auto note = [&](double difference, double size) {
                    worst = std::max(worst, difference / (1 + size));
                };
                note(length(Vec3d(both.core.state.velocity.vec(slot)) - twin.v[i]),
                     length(twin.v[i]));
                for (std::uint32_t k = 0; k < both.groom.envelope_points; ++k)
                    note(std::fabs(double{both.core.state.radius_rate.at(slot, k)} -
                                   twin.r_rate[i][k]),
                         std::fabs(twin.r_rate[i][k]));
                changed += length(twin.v[i] - before.wisps[w].v[i]) > 0.01;
            }
    }
    MESSAGE("largest difference " << worst);
    CHECK(changed > 5000);
    CHECK(worst < 5e-5);
}
