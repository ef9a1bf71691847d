/// Sliding contact with the character: the core against the twin, on the planes that the core found
/// (§4.2, M30).

#include "bodies/meshes.h"
#include "interactions/character_contact.h"
#include "reference/character.h"
#include "reference/random_groom.h"
#include "reference/random_numbers.h"
#include "step/core_contacts.h"
#include "step/core_hair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace mane;

namespace {

constexpr double kBlock = 1.0 / 120;
constexpr float kStep = 1e-3f, kFraction = 0.36f;

/// A ball among the hair that moves and turns over the block.
void throw_ball(Surface& surface, const Mesh& ball, reference::RandomNumbers& random) {
    const Vec3d place = random.vector(0.05), way = random.vector(0.02), turn = random.vector(0.05);
    std::vector<Vec3> start, end;
    for (const Vec3& v : ball.vertices) {
        const Vec3d rest(v);
        start.emplace_back(rest + place);
        end.emplace_back(rest + cross(turn, rest) + place + way);
    }
    surface.reset(start);
    surface.advance(end, kBlock);
}

} // namespace

TEST_CASE("sliding contacts answer as the twin's, for any K, masses, state and moving body") {
    const Mesh ball = test::icosphere(3, 0.1f);
    Surface surface(ball);
    const std::vector<ContactBody> bodies = {{&surface, false}};
    const CharacterContactDesc desc;
    Threads threads(1);
    double worst = 0;
    std::size_t planes = 0, changed = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const reference::RandomHair recipe = {.seed = seed,
                                              .wisps = 12,
                                              .points = static_cast<std::uint32_t>(3 + seed % 6),
                                              .least_sections = 3,
                                              .most_sections = 9,
                                              .spread = 0.3};
        const Groom groom = random_groom(recipe);
        const Frame frame = random_state(recipe, groom, seed);
        reference::Hair twin(groom);
        set_state(twin, frame);
        CoreHair core(groom);
        core.take(frame);
        core.take(all_frames(twin));
        reference::RandomNumbers random(seed);
        throw_ball(surface, ball, random);

        CharacterContacts contacts;
        contacts.detect(core.view(), bodies, desc, threads);
        contacts.respond(core.view(), desc, kFraction, kStep, core.state, threads);
        for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
            reference::Wisp& wisp = twin.wisps[w];
            const std::vector<reference::SlidingPlane> list =
                planes_of(contacts.of_wisp(w), double{kFraction}, kBlock);
            planes += list.size();
            slide(wisp, list, desc, double{kStep});
            for (std::size_t i = 2; i < wisp.sections(); ++i) {
                const Slot slot = core.slot(w, i);
                const auto note = [&](double difference, double size) {
                    worst = std::max(worst, difference / (1 + size));
                };
                note(length(Vec3d(core.state.velocity.vec(slot)) - wisp.v[i]), length(wisp.v[i]));
                for (std::uint32_t k = 0; k < groom.envelope_points; ++k)
                    note(std::fabs(double{core.state.radius_rate.at(slot, k)} - wisp.r_rate[i][k]),
                         std::fabs(wisp.r_rate[i][k]));
                changed +=
                    length(wisp.v[i] - Vec3d(frame.velocity[groom.first_section[w] + i])) > 0.01;
            }
        }
    }
    MESSAGE(planes << " planes, " << changed << " sections changed, largest difference " << worst);
    CHECK(planes > 1000);
    CHECK(changed > 100);
    // The velocity that a plane lets through is its gap over the step, and at the edge of the soft
    // last 0.1 mm it changes twice as fast with the gap: of a few roundings at 0.1 m, over 1 ms.
    CHECK(worst < 2e-4);
}
