/// Searches for a group of segments at once, in tangles of bent wisps: points as for each segment
/// alone, axes as by asking for all of them.

#include "instruction_sets.h"
#include "interactions/axis_search.h"
#include "interactions/axis_test.h"
#include "interactions/contact_geometry.h"
#include "interactions/near_all.h"
#include "interactions/point_test.h"
#include "interactions/toy_hair.h"
#include "model/section_frames.h"
#include "reference/random_numbers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <span>

using namespace mane;

namespace {

constexpr float kLeastSine = 0.17f;

/// Wisps of 3 cm segments within 4 cm, each bent by up to 120° at its sections, with radii
/// of 0.5 to 5 mm, some round, some flat.
test::ToyHair tangle(std::uint32_t k, reference::RandomNumbers& random) {
    constexpr float kSegment = 0.03f;
    std::vector<std::vector<Vec3>> wisps;
    for (int w = 0; w < 60; ++w) {
        Vec3 x(random.vector(0.04)), way(random.direction());
        wisps.push_back({x});
        const double bend = random.between(0, 1.7);
        for (int i = 0; i < 5; ++i) {
            wisps.back().push_back(x += way * kSegment);
            way = normalized(way + Vec3(random.direction()) * static_cast<float>(bend));
        }
    }
    test::ToyHair hair(wisps, k, 0.01f);
    for (std::uint32_t w = 0; w < hair.groom.wisp_count(); ++w) {
        std::vector<SectionFrame<float>> frames(wisps[w].size());
        const Vec3d way(normalized(wisps[w][1] - wisps[w][0]));
        const double size = random.around(1e-3, 5e-3), flat = random.between(0.5, 1);
        section_frames<float>(wisps[w], Vec3(random.across(way)), frames);
        for (std::uint32_t i = 0; i < frames.size(); ++i) {
            const Slot slot = hair.slot(w, i);
            hair.frames.u.set(slot, frames[i].u);
            hair.frames.v.set(slot, frames[i].v);
            hair.frames.normal.set(slot, frames[i].normal);
            for (std::uint32_t line = 0; line < k; ++line)
                hair.state.radius.at(slot, line) =
                    static_cast<float>(size * random.between(flat, 1));
        }
    }
    return hair;
}

std::vector<std::uint32_t> segments(const ContactPoints& points) {
    std::vector<std::uint32_t> ranks;
    for (std::uint32_t r = 0; r < points.order.size(); ++r)
        if (points.order.next(r) != ContactOrder::kNone)
            ranks.push_back(r);
    return ranks;
}

/// A tangle as the searches take it.
struct Searched {
    test::ToyHair hair;
    ContactGeometry geometry;
    NearBoxes near;
    std::vector<std::uint32_t> ranks; // at which segments begin

    Searched(std::uint32_t k, reference::RandomNumbers& random) : hair(tangle(k, random)) {
        Threads threads(1);
        geometry.take(hair.view(), threads);
        near = test::near_all(points());
        ranks = segments(points());
    }
    const ContactPoints& points() const { return geometry.points(); }
};

/// Cuts ranks into groups of one, two, … sixteen, one, …
template <typename Use> void for_groups(std::span<const std::uint32_t> ranks, Use&& use) {
    for (std::size_t first = 0, size = 1; first < ranks.size();
         first += size, size = size % kLanes + 1)
        use(ranks.subspan(first, std::min(size, ranks.size() - first)));
}

} // namespace

TEST_CASE("segments together hold the points that they hold alone") {
    reference::RandomNumbers random(3);
    const auto tests = test::on_all_sets(point_test_for);
    std::size_t inside = 0;
    for (std::uint32_t k = 3; k <= kMaxEnvelopePoints; ++k) {
        const Searched searched(k, random);
        const ContactPoints& points = searched.points();
        const NearBoxes& near = searched.near;
        for_groups(searched.ranks, [&](std::span<const std::uint32_t> group) {
            for (const PointTest& test : tests) {
                std::array<PointsInside, kLanes> together;
                test.find(points, group, near, together.data());
                for (std::size_t i = 0; i < group.size(); ++i) {
                    PointsInside alone;
                    test.find(points, group.subspan(i, 1), near, &alone);
                    REQUIRE(together[i].count == alone.count);
                    CHECK(std::equal(alone.point.begin(),
                                     alone.point.begin() + static_cast<std::ptrdiff_t>(alone.count),
                                     together[i].point.begin()));
                    inside += alone.count;
                }
            }
        });
    }
    CHECK(inside > 1000);
}

TEST_CASE("the search for axes leaves out no contact and finds none twice, for any instruction set "
          "and K") {
    reference::RandomNumbers random(4);
    const auto searches = test::on_all_sets(axis_search_for);
    std::size_t contacts = 0, candidates = 0, missed_by_thinner = 0;
    for (std::uint32_t k = 3; k <= kMaxEnvelopePoints; ++k) {
        const Searched searched(k, random);
        const ContactPoints& points = searched.points();
        const NearBoxes& near = searched.near;
        const std::vector<std::uint32_t>& ranks = searched.ranks;
        AlignedVector<AxisBunch> axes(points.bunches());
        for (AxisBunch& bunch : axes)
            bunch.clear();
        const auto slender = [](std::uint32_t rank) { return rank % 3 != 0; };
        for (const std::uint32_t rank : ranks)
            axes[rank / kLanes].set(points, rank, slender(rank));
        AlignedVector<AxisBunch> thinner = axes;
        for (AxisBunch& bunch : thinner)
            for (float& widest : bunch.widest)
                widest *= 0.5f;

        const auto met_by = [&](std::uint32_t rank) {
            const auto direction = [&](std::uint32_t r) {
                return Vec3d(first_three(points.direction[r]));
            };
            std::vector<std::uint32_t> met;
            for (const std::uint32_t other : ranks)
                if (other != rank && !(other < rank && slender(other)) &&
                    segment_box(points, rank).overlaps(segment_box(points, other)) &&
                    length(cross(direction(rank), direction(other))) > double{kLeastSine} + 1e-6 &&
                    axis_contact(points, std::min(rank, other), std::max(rank, other)))
                    met.push_back(other);
            return met;
        };
        for_groups(ranks, [&](std::span<const std::uint32_t> group) {
            using Found = std::array<std::vector<std::uint32_t>, kLanes>;
            Found first;
            for (const AxisSearch& search : searches) {
                Found found, fewer;
                search.find(points, axes.data(), group, kLeastSine, near, found.data());
                search.find(points, thinner.data(), group, kLeastSine, near, fewer.data());
                for (std::size_t i = 0; i < group.size(); ++i) {
                    const std::vector<std::uint32_t> met = met_by(group[i]);
                    const auto holds_all = [&](const std::vector<std::uint32_t>& among) {
                        return std::includes(among.begin(), among.end(), met.begin(), met.end());
                    };
                    CHECK(holds_all(found[i]));
                    for (const std::uint32_t other : found[i]) // each pair from one side
                        CHECK((other > group[i] || (other < group[i] && !slender(other))));
                    missed_by_thinner += !holds_all(fewer[i]);
                    contacts += met.size();
                    candidates += found[i].size();
                }
                if (&search == &searches.front())
                    first = found;
                CHECK(found == first);
            }
        });
    }
    CHECK(contacts > 500);
    CHECK(candidates < 3 * contacts);
    CHECK(missed_by_thinner > 0);
}
