/// The search for boxes and points of §4.1 against looking at every one.

#include "interactions/point_test.h"
#include "reference/random_numbers.h"

#include "mane/error.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace mane;

namespace {

std::vector<PointTest> tests_here() {
    std::vector<PointTest> tests;
    for (const char* name : {"avx512", "avx2", "sse4", "neon", "scalar"}) {
        try {
            tests.push_back(point_test_for(name));
        } catch (const InputError&) {
            MESSAGE("skipped: no " << std::string(name) << " on this machine");
        }
    }
    return tests;
}

Vec3 random_point(reference::RandomNumbers& random, double size) {
    return Vec3(random.vector(size));
}

} // namespace

TEST_CASE("a tree of boxes finds exactly those that overlap, wherever they have moved since") {
    reference::RandomNumbers random(1);
    const std::vector<PointTest> tests = tests_here();
    for (std::size_t count : {0, 1, 2, 15, 16, 17, 31, 255, 256, 257, 1000, 4099}) {
        std::vector<Vec3> centres;
        for (std::size_t i = 0; i < count; ++i)
            centres.push_back(random_point(random, 1));
        BoxTree tree;
        tree.arrange(centres);
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
                    std::vector<std::uint32_t> found(count + 1, ~0u);
                    found.resize(test.overlapping(tree, box, found.data(), found.size()));
                    std::sort(found.begin(), found.end());
                    CHECK(found == expected);
                    // Too little room: the number is told all the same, and nothing past it
                    // written.
                    std::vector<std::uint32_t> few(expected.size() / 2 + 1, 7u);
                    CHECK(test.overlapping(tree, box, few.data(), few.size() - 1) ==
                          expected.size());
                    CHECK(few.back() == 7u);
                }
            }
        }
    }
}

TEST_CASE("a slanted box of a segment holds the same points for every instruction set and K") {
    reference::RandomNumbers random(2);
    const std::vector<PointTest> tests = tests_here();
    std::size_t inside = 0;
    for (std::uint32_t k = 3; k <= kMaxEnvelopePoints; ++k) {
        const std::vector<HalfLine> lines = half_lines(k);
        for (std::size_t sections : {1, 2, 7, 60}) { // 60 × (K + 1) wait for more than one test
            SegmentVolume volume;
            volume.end[0] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
            volume.end[1] = {{0, 0.1f, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, -1}};
            for (VolumeEnd& end : volume.end) {
                for (std::uint32_t i = 0; i < k; ++i)
                    end.radius[i] = static_cast<float>(random.between(0.02, 0.05));
                end.area = end.rest_area = 1;
            }
            volume.box = {{-0.05f, -0.01f, -0.05f}, {0.05f, 0.11f, 0.05f}};
            const std::uint32_t per_section = k + 1;
            std::vector<float> xyz[3];
            for (std::vector<float>& axis : xyz)
                for (std::size_t i = 0; i < sections * per_section + kLanes; ++i)
                    axis.push_back(static_cast<float>(random.between(-0.06, 0.12)));
            std::vector<std::uint32_t> candidates(sections);
            for (std::uint32_t i = 0; i < sections; ++i)
                candidates[i] = static_cast<std::uint32_t>(sections) - 1 - i;
            const SectionPoints points{xyz[0].data(), xyz[1].data(), xyz[2].data(), per_section};
            // This volume is upright, so a point is inside between 0 and 0.1 m where its section
            // coordinates are x and −z.
            const auto depth = [&](std::uint32_t p) {
                const double a = double{xyz[0][p]}, b = -double{xyz[2][p]}, s = xyz[1][p] / 0.1;
                double best = -1, squared = 0;
                for (std::uint32_t i = 0; i < k; ++i) {
                    const HalfLine &d = lines[i], &e = lines[(i + 1) % k];
                    const double sine = lines[1].sine;
                    const double alpha = (a * e.sine - b * e.cosine) / sine,
                                 beta = (d.cosine * b - d.sine * a) / sine;
                    const auto radius = [&](std::uint32_t j) {
                        return volume.end[0].radius[j] * (1 - s) + volume.end[1].radius[j] * s;
                    };
                    const double u = alpha / radius(i), v = beta / radius((i + 1) % k);
                    if (std::min(alpha, beta) > best) {
                        best = std::min(alpha, beta);
                        squared = u * u + v * v + 2 * u * v * lines[1].cosine;
                    }
                }
                return std::sqrt(squared);
            };
            std::vector<std::uint32_t> expected, uncertain;
            for (const std::uint32_t section : candidates)
                for (std::uint32_t c = 0; c < per_section; ++c) {
                    const std::uint32_t p = section * per_section + c;
                    const double y = double{xyz[1][p]}, margin = 1e-4;
                    const double d = depth(p);
                    if (std::fabs(d - 1) < margin || std::fabs(y) < 1e-6 ||
                        std::fabs(y - 0.1) < 1e-6)
                        uncertain.push_back(p);
                    else if (y > 0 && y < 0.1 && d < 1)
                        expected.push_back(p);
                }
            std::vector<PointInside> first;
            for (const PointTest& test : tests) {
                std::vector<PointInside> found(sections * per_section);
                found.resize(test.find(volume, lines, points, candidates, found.data()));
                std::vector<std::uint32_t> certain;
                for (const PointInside& in : found) {
                    if (std::find(uncertain.begin(), uncertain.end(), in.point) == uncertain.end())
                        certain.push_back(in.point);
                    CHECK(std::fabs(in.depth - depth(in.point)) < 1e-5);
                    CHECK(std::fabs(in.s - xyz[1][in.point] / 0.1f) < 1e-5f);
                }
                CHECK(certain == expected);
                if (first.empty())
                    first = found;
                REQUIRE(found.size() == first.size());
                for (std::size_t i = 0; i < found.size(); ++i)
                    CHECK((found[i].point == first[i].point && found[i].s == first[i].s &&
                           found[i].depth == first[i].depth &&
                           found[i].density == first[i].density));
            }
            inside += expected.size();
        }
    }
    CHECK(inside > 50);
}
