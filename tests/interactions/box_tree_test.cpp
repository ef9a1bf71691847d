/// The search for boxes and points of §4.1 against looking at every one.

#include "instruction_sets.h"
#include "interactions/contact_geometry.h"
#include "interactions/near_all.h"
#include "interactions/point_test.h"
#include "interactions/toy_hair.h"
#include "reference/random_numbers.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace mane;

namespace {

Vec3 random_point(reference::RandomNumbers& random, double size) {
    return Vec3(random.vector(size));
}

} // namespace

TEST_CASE("a tree of boxes finds exactly those that overlap, wherever they have moved since") {
    reference::RandomNumbers random(1);
    const std::vector<PointTest> tests = test::on_all_sets(point_test_for);
    for (std::size_t count : {0, 1, 2, 15, 16, 17, 31, 255, 256, 257, 1000, 4099}) {
        std::vector<Vec3> centres;
        for (std::size_t i = 0; i < count; ++i)
            centres.push_back(random_point(random, 1));
        BoxTree tree;
        for (int moved = 0; moved < 3; ++moved) {
            std::vector<Box> boxes;
            for (const Vec3& c : centres) {
                const Vec3 middle = c + random_point(random, 0.3 * moved);
                boxes.push_back({middle, middle});
                boxes.back().add(middle + random_point(random, 0.1));
            }
            tree.update(boxes);
            for (int query = 0; query < 20; ++query) {
                Box box{random_point(random, 1), {}};
                box.high = box.low;
                box.add(box.low + random_point(random, query % 2 ? 0.2 : 1));
                std::vector<std::uint32_t> expected;
                for (std::uint32_t i = 0; i < count; ++i)
                    if (boxes[i].overlaps(box))
                        expected.push_back(i);
                for (const PointTest& test : tests) {
                    NearBoxes near;
                    test.gather(tree, box, near);
                    CHECK(near.items == expected);
                }
            }
        }
    }
}

TEST_CASE("what is not a number overlaps nothing") {
    constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();
    for (const PointTest& test : test::on_all_sets(point_test_for))
        for (std::size_t count : {1, 3, 40, 300}) { // nodes that are not full, too
            const Vec3 nowhere{kNothing, kNothing, kNothing};
            const std::vector<Box> boxes(count, Box{{0, 0, 0}, {1, 1, 1}}),
                lost(count, {nowhere, nowhere});
            BoxTree tree;
            NearBoxes near;
            tree.update(boxes);
            test.gather(tree, {nowhere, nowhere}, near);
            CHECK(near.items.empty());
            test.gather(tree, {{0, 0, 0}, {1, kNothing, 1}}, near);
            CHECK(near.items.empty());
            tree.update(lost);
            test.gather(tree, {{-1, -1, -1}, {2, 2, 2}}, near);
            CHECK(near.items.empty());
        }
}

namespace {

/// A wisp that stands upright from 0 to 0.1 m, its radii of many sizes, among many short ones.
test::ToyHair upright_among(std::size_t others, std::uint32_t k, reference::RandomNumbers& random) {
    std::vector<std::vector<Vec3>> wisps = {{{0, -0.1f, 0}, {0, 0, 0}, {0, 0.1f, 0}, {0, 0.3f, 0}}};
    for (std::size_t i = 0; i < others; ++i) {
        const Vec3 middle = random_point(random, 0.06) + Vec3{0, 0.05f, 0};
        wisps.emplace_back();
        for (int p = 0; p < 4; ++p)
            wisps.back().push_back(middle + random_point(random, 0.06));
    }
    test::ToyHair hair(wisps, k, 0.01f);
    for (std::uint32_t section = 0; section < hair.groom.section_count(); ++section)
        for (std::uint32_t i = 0; i < k; ++i)
            hair.state.radius.at(hair.layout->slot(section), i) =
                static_cast<float>(random.between(0.02, 0.05));
    return hair;
}

/// The depth of a point at height y in the upright segment that begins at `rank` (M14a), written
/// plainly.
double depth_in_upright(const ContactPoints& points, std::uint32_t rank, const Vec3& p) {
    const std::uint32_t next = points.order.next(rank), k = points.per_section - 1;
    const auto axis = [&](const Four& d) { return Vec3d(first_three(d)); };
    const double a = dot(Vec3d(p), axis(points.half_line[points.place(rank, 1)])),
                 b = dot(Vec3d(p), Vec3d(points.shape[rank].v)), s = double{p.y} / 0.1;
    const std::vector<HalfLine>& lines = points.half_lines;
    double best = -1, squared = 0;
    for (std::uint32_t i = 0; i < k; ++i) {
        const HalfLine &d = lines[i], &e = lines[(i + 1) % k];
        const double sine = lines[1].sine;
        const double alpha = (a * e.sine - b * e.cosine) / sine,
                     beta = (d.cosine * b - d.sine * a) / sine;
        const auto radius = [&](std::uint32_t j) {
            return points.shape[rank].radius[j] * (1 - s) + points.shape[next].radius[j] * s;
        };
        const double u = alpha / radius(i), v = beta / radius((i + 1) % k);
        if (std::min(alpha, beta) > best) {
            best = std::min(alpha, beta);
            squared = u * u + v * v + 2 * u * v * lines[1].cosine;
        }
    }
    return std::sqrt(squared);
}

} // namespace

TEST_CASE("a segment holds the same points for every instruction set and K") {
    reference::RandomNumbers random(2);
    const std::vector<PointTest> tests = test::on_all_sets(point_test_for);
    std::size_t inside = 0;
    for (std::uint32_t k = 3; k <= kMaxEnvelopePoints; ++k) {
        for (std::size_t others : {1, 2, 7, 60}) { // 240 sections wait for more than one test
            const test::ToyHair hair = upright_among(others, k, random);
            Threads threads(1);
            ContactGeometry geometry;
            geometry.take(hair.view(), threads);
            const ContactPoints& points = geometry.points();
            const std::uint32_t rank = points.order.rank(1), next = points.order.next(rank);
            const NearBoxes near = test::near_all(points);

            std::vector<std::uint32_t> expected, uncertain;
            for (const std::uint32_t bunch : near.items)
                for (std::uint32_t code = 0; code <= k; ++code)
                    for (std::uint32_t r = bunch * kLanes;
                         r < std::min((bunch + 1) * kLanes, points.order.size()); ++r) {
                        const std::uint32_t at = points.place(r, code);
                        const Vec3 p{points.x[at], points.y[at], points.z[at]};
                        if (r == rank || r == next || p.y > 1)
                            continue;
                        const double margin = 1e-4, depth = depth_in_upright(points, rank, p);
                        if (std::fabs(depth - 1) < margin || std::fabs(p.y) < 1e-6f ||
                            std::fabs(p.y - 0.1f) < 1e-6f)
                            uncertain.push_back(r * 16 + code);
                        else if (p.y > 0 && p.y < 0.1f && depth < 1)
                            expected.push_back(r * 16 + code);
                    }
            PointsInside first;
            for (const PointTest& test : tests) {
                PointsInside found;
                test.find(points, {&rank, 1}, near, &found);
                std::vector<std::uint32_t> certain;
                for (std::size_t i = 0; i < found.count; ++i) {
                    const std::uint32_t point = found.point[i],
                                        at = points.place(point / 16, point % 16);
                    const Vec3 p{points.x[at], points.y[at], points.z[at]};
                    if (std::find(uncertain.begin(), uncertain.end(), point) == uncertain.end())
                        certain.push_back(point);
                    CHECK(std::fabs(double{found.depth[i]} - depth_in_upright(points, rank, p)) <
                          1e-5);
                    CHECK(std::fabs(found.s[i] - p.y / 0.1f) < 1e-5f);
                }
                CHECK(certain == expected);
                if (first.count == 0)
                    first = found;
                REQUIRE(found.count == first.count);
                for (std::size_t i = 0; i < found.count; ++i)
                    CHECK((found.point[i] == first.point[i] && found.s[i] == first.s[i] &&
                           found.depth[i] == first.depth[i] &&
                           found.density[i] == first.density[i]));
            }
            inside += expected.size();
        }
    }
    CHECK(inside > 50);
}
