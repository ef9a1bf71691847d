#include "mane/strands.h"

#include "mane/error.h"
#include "random_hair.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>

using namespace mane;
using namespace mane::test;

namespace {

StrandDesc plain(std::uint32_t count) {
    StrandDesc desc;
    desc.count = count;
    desc.jitter = desc.length_jitter = 0;
    return desc;
}

StrandShape posed(const Hair& hair, const StrandDesc& desc, std::uint32_t samples = 4) {
    StrandShape shape(hair.groom, desc, 5, samples);
    shape.pose(hair.frame);
    return shape;
}

// Largest depth of any vertex in the drawn envelope.
double largest_depth(const Hair& hair, const StrandDesc& desc, std::uint32_t samples) {
    const StrandShape shape = posed(hair, desc, samples);
    const Curves curves = make_strands(hair.groom, hair.frame, desc, 5, samples);
    double largest = 0;
    for (std::size_t s = 0; s < shape.strand_count(); ++s) {
        const EnvelopeGauge envelope(hair.groom, hair.frame, shape.wisp(s));
        for (std::uint32_t v = curves.first_vertex[s]; v < curves.first_vertex[s + 1]; ++v)
            largest = std::max(
                largest,
                envelope.depth(Vec3d(curves.position[v]),
                               double{shape.parameter(s, v - curves.first_vertex[s])}, 2e-6));
    }
    return largest;
}

// Catmull-Rom as Bézier pieces, by de Casteljau's halving: the textbook's other form.
template <typename Control> Vec3d bezier_catmull_rom(Control control, double p, std::size_t last) {
    const std::size_t i = std::min(static_cast<std::size_t>(p), last - 1);
    const double t = p - static_cast<double>(i);
    const Vec3d before = control(i == 0 ? 0 : i - 1), a = control(i), b = control(i + 1),
                after = control(std::min(i + 2, last));
    Vec3d q[4] = {a, a + (b - before) / 6.0, b - (after - a) / 6.0, b};
    for (int round = 3; round > 0; --round)
        for (int j = 0; j < round; ++j)
            q[j] += (q[j + 1] - q[j]) * t;
    return q[0];
}

} // namespace

TEST_CASE("strands: no point leaves the drawn envelope, however bent and pressed the wisp (M17)") {
    for (std::uint32_t k = 3; k <= 8; ++k)
        for (unsigned seed = 0; seed < 6; ++seed) {
            HairRecipe recipe;
            recipe.k = k;
            recipe.bend = 0.3 * seed;
            StrandDesc desc;
            desc.count = 80;
            desc.distribution = seed % 2 ? StrandDistribution::rim : StrandDistribution::uniform;
            desc.jitter = 0.18f * static_cast<float>(seed);
            desc.length_jitter = 0.3f;
            desc.waves = seed % 3 ? 5 : 0;
            desc.wave_amplitude = 0.1f * static_cast<float>(seed);
            const double depth = largest_depth(random_hair(recipe, seed * 10 + k), desc, 5);
            CAPTURE(k);
            CAPTURE(seed);
            CHECK(depth <= 1.001); // float rounding; M17 grants 1.02
        }
}

TEST_CASE("strands: the disc is no smaller than jitter and waves ask") {
    HairRecipe recipe;
    recipe.squeeze = 0;
    StrandDesc desc = plain(4000);
    desc.distribution = StrandDistribution::rim;
    CHECK(largest_depth(random_hair(recipe, 1), desc, 1) > 0.999);
    desc.waves = 3;
    desc.wave_amplitude = 0.4f;
    CHECK(largest_depth(random_hair(recipe, 1), desc, 4) > 0.98);
}

TEST_CASE("strands: without jitter they are the Catmull-Rom curves through their points in the "
          "sections (§5.2)") {
    HairRecipe recipe;
    recipe.wisps = 1;
    const Hair hair = random_hair(recipe, 4);
    const std::uint32_t samples = 6, sections = recipe.sections;
    const Curves curves = make_strands(hair.groom, hair.frame, plain(50), 5, samples);
    for (std::size_t s = 0; s < 50; ++s) {
        const auto control = [&](std::size_t i) {
            return Vec3d(curves.position[curves.first_vertex[s] + i * samples]);
        };
        for (std::uint32_t v = 0; v <= samples * (sections - 1); ++v) {
            const Vec3d expected = bezier_catmull_rom(control, double(v) / samples, sections - 1);
            CHECK(length(Vec3d(curves.position[curves.first_vertex[s] + v]) - expected) < 1e-6);
        }
    }
}

TEST_CASE("strands: the first and the last control point are on the curve, jitter or not") {
    const Hair hair = random_hair({}, 9);
    StrandDesc desc = plain(60);
    desc.jitter = 0.5f;
    const Curves curves = make_strands(hair.groom, hair.frame, desc, 5, 4);
    const StrandShape shape = posed(hair, desc, 4);
    for (std::size_t s = 0; s < 60; ++s) {
        const std::size_t first = hair.groom.first_section[shape.wisp(s)];
        const std::size_t last = hair.groom.first_section[shape.wisp(s) + 1] - 1;
        const auto off_plane = [&](std::uint32_t vertex, std::size_t section, std::size_t from,
                                   std::size_t to) {
            const Vec3 normal = normalized(hair.frame.position[to] - hair.frame.position[from]);
            return std::abs(dot(curves.position[vertex] - hair.frame.position[section], normal));
        };
        CHECK(off_plane(curves.first_vertex[s], first, first, first + 1) < 1e-6f);
        CHECK(off_plane(curves.first_vertex[s + 1] - 1, last, last - 1, last) < 1e-6f);
        CHECK(shape.parameter(s, shape.outside_vertex()) == 1.0f);
    }
}

TEST_CASE("strands: a strand keeps its place in its wisp from frame to frame (M15)") {
    HairRecipe recipe;
    recipe.k = 5;
    const Hair hair = random_hair(recipe, 1), later = random_hair(recipe, 2);
    StrandDesc desc = plain(40);
    desc.jitter = 0.6f;
    const std::uint32_t samples = 3;
    const Curves a = make_strands(hair.groom, hair.frame, desc, 5, samples);
    const Curves b = make_strands(hair.groom, later.frame, desc, 5, samples);
    const StrandShape shape = posed(hair, desc, samples);
    for (std::size_t s = 0; s < 40; ++s) {
        const EnvelopeGauge before(hair.groom, hair.frame, shape.wisp(s)),
            after(hair.groom, later.frame, shape.wisp(s));
        for (std::uint32_t i = 0; i < recipe.sections; ++i) {
            const std::uint32_t v = a.first_vertex[s] + i * samples;
            CHECK(before.depth(Vec3d(a.position[v]), i, 2e-6) ==
                  doctest::Approx(after.depth(Vec3d(b.position[v]), i, 2e-6)).epsilon(2e-3));
        }
    }
}

TEST_CASE("strands: any strand alone, any part, any number of threads: the same bits") {
    const Hair hair = random_hair({}, 3);
    StrandDesc desc;
    desc.count = 1500;
    desc.waves = 4;
    desc.wave_amplitude = 0.2f;
    const Curves all = make_strands(hair.groom, hair.frame, desc, 5, 4, 1);
    const Curves threads = make_strands(hair.groom, hair.frame, desc, 5, 4, 3);
    CHECK(all.position == threads.position);
    CHECK(all.width == threads.width);

    const StrandShape shape = posed(hair, desc, 4);
    for (const std::size_t s :
         {std::size_t{0}, std::size_t{1}, std::size_t{700}, std::size_t{1499}}) {
        const std::size_t begin = shape.first_vertex(s), size = shape.first_vertex(s + 1) - begin;
        std::vector<Vec3> positions(size);
        std::vector<float> widths(size);
        shape.fill(s, 1, positions, widths);
        CHECK(std::equal(positions.begin(), positions.end(),
                         all.position.begin() + static_cast<std::ptrdiff_t>(begin)));
        CHECK(std::equal(widths.begin(), widths.end(),
                         all.width.begin() + static_cast<std::ptrdiff_t>(begin)));
    }
    CHECK(make_strands(hair.groom, hair.frame, desc, 6, 4).position != all.position);
}

TEST_CASE("strands: jitter moves control points toward the skeleton by up to its share, evenly") {
    const Hair hair = straight_hair(6);
    StrandDesc desc = plain(3000);
    const Curves still = make_strands(hair.groom, hair.frame, desc, 5, 1);
    desc.jitter = 0.4f;
    const Curves moved = make_strands(hair.groom, hair.frame, desc, 5, 1);
    double sum = 0, least = 1, most = 0;
    const auto across = [](const Vec3& p) {
        return std::sqrt(double{p.x} * p.x + double{p.z} * p.z);
    };
    for (std::size_t v = 0; v < moved.position.size(); ++v) {
        const double share = across(moved.position[v]) * (1 + 0.4 / 8) / across(still.position[v]);
        sum += share;
        least = std::min(least, share), most = std::max(most, share);
    }
    const double n = static_cast<double>(moved.position.size());
    CHECK(least >= 0.6 - 1e-5);
    CHECK(most <= 1 + 1e-5);
    CHECK(std::abs(sum / n - 0.8) < 4 * 0.4 / std::sqrt(12 * n)); // four standard errors
}

TEST_CASE("strands: length is shortened by up to its share, evenly, and x₁'s vertex stays") {
    const Hair hair = straight_hair(8);
    StrandDesc desc = plain(4000);
    desc.length_jitter = 0.5f;
    const Curves curves = make_strands(hair.groom, hair.frame, desc, 5, 4);
    const StrandShape shape = posed(hair, desc);
    const double full = 0.04 * 6;
    double sum = 0;
    for (std::size_t s = 0; s < 4000; ++s) {
        const std::uint32_t first = curves.first_vertex[s];
        CHECK(curves.position[first + 4].y == doctest::Approx(-0.04f));
        const double share =
            (-0.04 - double{curves.position[curves.first_vertex[s + 1] - 1].y}) / full;
        CHECK(share >= 0.5 - 1e-5);
        CHECK(share <= 1 + 1e-5);
        sum += share;
    }
    CHECK(std::abs(sum / 4000 - 0.75) < 4 * 0.5 / std::sqrt(12 * 4000.0));
}

TEST_CASE("strands: spread over the wisps in proportion, fewer are a part of more") {
    const Hair hair = random_hair({}, 3);
    StrandDesc few = plain(46), many = plain(460);
    const StrandShape shape = posed(hair, many);
    std::vector<std::uint32_t> counts(4);
    for (std::size_t s = 0; s < shape.strand_count(); ++s)
        ++counts[shape.wisp(s)];
    CHECK(counts == hair.groom.strands); // 100, 110, 120, 130

    const Curves a = make_strands(hair.groom, hair.frame, few, 5),
                 b = make_strands(hair.groom, hair.frame, many, 5);
    for (std::uint32_t v = 0; v < 10 * 33; ++v)
        CHECK(a.position[v] == b.position[v]);
}

TEST_CASE("strands: a million") {
    const Hair hair = random_hair({.sections = 3}, 3);
    const Curves curves = make_strands(hair.groom, hair.frame, plain(1000000), 5, 1);
    CHECK(curves.first_vertex.size() == 1000001);
    CHECK(curves.position.size() == 3000000);
    CHECK(curves.position[2999999] != Vec3{});
    CHECK(curves.width.front() == 80e-6f);
    CHECK(curves.width.back() == doctest::Approx(30e-6f));
}

TEST_CASE("strands: what does not fit is said") {
    Hair hair = random_hair({}, 3);
    CHECK_THROWS_WITH_AS(StrandShape(hair.groom, plain(10), 5, 0),
                         "strands need at least 1 sample per segment, found 0", InputError);
    hair.frame.radius.pop_back();
    CHECK_THROWS_WITH_AS(posed(hair, plain(10)),
                         "the frame does not fit the groom: it has 143 radii, expected 144",
                         InputError);
    CHECK_THROWS_WITH_AS(make_strands(straight_hair(2).groom, straight_hair(2).frame, plain(10), 5),
                         "wisp 0 has 2 sections, expected at least 3", InputError);
}
