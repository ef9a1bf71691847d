/// Detection passes over most points; here every point of every wisp is looked at.

#include "base/random.h"
#include "interactions/character_planes.h"
#include "interactions/toy_hair.h"
#include "mane/character.h"

#include <doctest/doctest.h>

using namespace mane;
using namespace mane::test;

namespace {

constexpr double kBlock = 1.0 / 120;
constexpr std::uint32_t kLines = 5;

Vec3 ball(const Random& random, std::uint64_t n, float size) {
    return {random.between(3 * n, -size, size), random.between(3 * n + 1, -size, size),
            random.between(3 * n + 2, -size, size)};
}

/// Wisps about the head: along the skin, through it and far off, with velocities of their own.
ToyHair scattered_hair() {
    const Random random(5, 1);
    std::vector<std::vector<Vec3>> wisps;
    for (std::uint64_t w = 0; w < 150; ++w) {
        std::vector<Vec3> points{Vec3(0, 1.55f, 0) + ball(random, 100 * w, 0.14f)};
        const Vec3 way = ball(random, 100 * w + 1, 0.03f);
        for (std::uint64_t i = 2; i < 8; ++i)
            points.push_back(points.back() + way + ball(random, 100 * w + i, 0.02f));
        wisps.push_back(points);
    }
    ToyHair hair(wisps, kLines, 0.013f);
    for (std::uint32_t w = 0; w < wisps.size(); ++w) {
        for (std::uint32_t i = 2; i < hair.groom.sections(w); ++i) {
            const std::uint64_t n = 100000 + 10 * w + i;
            hair.state.velocity.set(hair.slot(w, i), ball(random, n, 0.5f));
            for (std::uint32_t line = 0; line < kLines; ++line)
                hair.state.radius_rate.at(hair.slot(w, i), line) =
                    random.between(1000000 + 50 * n + line, -0.1f, 0.1f);
        }
    }
    hair.find_frames();
    return hair;
}

/// The planes of a point, the surface being at rest.
std::vector<NearPlane> asked(const Surface& surface, const WispCopy& wisp, const WispPoint& point) {
    const CharacterContactDesc desc;
    Approach approach;
    approach.position = Vec3d(wisp.position(point));
    approach.velocity = Vec3d(wisp.velocity(point));
    approach.speed = length(approach.velocity);
    approach.threshold = double(desc.threshold);
    approach.push_out = double(desc.push_out);
    PlaneFinder finder;
    return finder.find(surface, approach);
}

bool same_point(const WispPoint& a, const WispPoint& b) {
    return a.section == b.section && a.along == b.along && a.k == b.k && a.alpha == b.alpha &&
           a.beta == b.beta;
}

/// The contacts of a point are the planes that are asked for, bit for bit. How many there are.
std::size_t check_point(const Surface& surface, const WispCopy& wisp, const WispPoint& point,
                        std::span<const SlidingContact> contacts) {
    const std::vector<NearPlane> planes = asked(surface, wisp, point);
    std::size_t count = 0;
    for (const SlidingContact& contact : contacts) {
        if (!same_point(contact.point, point))
            continue;
        REQUIRE(count < planes.size());
        const NearPlane& plane = planes[count++];
        CHECK(contact.triangle == plane.place.triangle);
        CHECK(contact.anchor == Vec3(plane.place.closest.point));
        CHECK(contact.normal == Vec3(plane.normal));
        CHECK(contact.threshold == float(plane.threshold));
    }
    CHECK(count == planes.size());
    return count;
}

} // namespace

TEST_CASE("what detection passes over has no planes, block after block") {
    const Body bust = make_bust();
    Surface surface(bust.mesh);
    surface.advance(bust.mesh.vertices, kBlock);
    const std::vector<ContactBody> bodies{{&surface, false}};
    ToyHair hair = scattered_hair();
    const Random random(6, 1);
    CharacterContacts contacts;
    Threads threads(1);
    std::size_t count = 0;
    for (std::uint64_t block = 0; block < 4; ++block) {
        contacts.detect(hair.view(), bodies, {}, threads);
        for (std::uint32_t w = 0; w < hair.groom.wisp_count(); ++w) {
            WispCopy wisp;
            wisp.load(hair.view(), w);
            for (std::uint32_t i = 2; i < wisp.sections(); ++i) {
                const auto of_wisp = contacts.of_wisp(w);
                count += check_point(surface, wisp, {i, 0, 0, 0, 0}, of_wisp);
                count += check_point(surface, wisp, {i - 1, 0.5f, 0, 0, 0}, of_wisp);
                for (std::uint32_t line = 0; line < kLines; ++line)
                    count += check_point(surface, wisp, {i, 0, line, 1, 0}, of_wisp);
                const Vec3 moved = hair.x(w, i) + ball(random, 1000 * block + 10 * w + i, 0.002f);
                hair.state.position.set(hair.slot(w, i), moved);
            }
        }
        hair.find_frames();
    }
    CHECK(count > 500);
}
