#include "base/instruction_set.h"
#include "plain_strand.h"

#include "mane/error.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <numeric>
#include <string>

using namespace mane;
using namespace mane::test;

namespace {

// Everything on, but for what the numbers' remainders leave out.
StrandDesc desc_for(unsigned number, std::uint32_t count) {
    StrandDesc desc;
    desc.count = count;
    desc.jitter = number % 2 ? 0.4f : 0;
    desc.length_jitter = number % 3 ? 0.5f : 0;
    desc.waves = number % 4 < 2 ? 2.5f : 0;
    desc.wave_amplitude = 0.3f;
    desc.curls = number % 5 < 3 ? 1.5f : 0;
    desc.distribution = number % 7 < 3 ? StrandDistribution::rim : StrandDistribution::gaussian;
    return desc;
}

// Wisps of different lengths, so that packs end anywhere.
Hair hair_for(unsigned number) {
    HairRecipe recipe;
    recipe.wisps = 3;
    recipe.k = 3 + number % 6;
    recipe.sections = 3 + number * 5 % 37;
    recipe.bend = 0.4;
    return random_hair(recipe, number);
}

struct Drawn {
    std::vector<Vec3> positions;
    std::vector<float> widths;
    bool operator==(const Drawn&) const = default;
};
Drawn drawn(const StrandShape& shape) {
    Drawn all{std::vector<Vec3>(shape.vertex_count()), std::vector<float>(shape.vertex_count())};
    shape.fill(all.positions, all.widths);
    return all;
}

} // namespace

TEST_CASE("strands: as the twin draws them, for all counts of half lines, sections and samples") {
    for (unsigned number = 0; number < 60; ++number) {
        CAPTURE(number);
        const Hair hair = hair_for(number);
        const StrandDesc desc = desc_for(number, 7 + number % 50);
        const std::uint32_t samples = 1 + number % 9;
        StrandShape shape(hair.groom, desc, 5, samples);
        shape.pose(hair.frame);
        const Drawn all = drawn(shape);
        double farthest = 0, widest = 0;
        std::size_t first = 0; // strand of its wisp
        for (std::size_t s = 0; s < shape.strand_count(); ++s) {
            if (s > 0 && shape.wisp(s) != shape.wisp(s - 1))
                first = s;
            const PlainStrand twin(hair, desc, 5, shape.wisp(s), s - first);
            const std::size_t begin = shape.first_vertex(s), last = shape.first_vertex(s + 1) - 1;
            const auto end = double{shape.parameter(s, static_cast<std::uint32_t>(last - begin))};
            for (std::size_t v = begin; v <= last; ++v) {
                const auto p = double{shape.parameter(s, static_cast<std::uint32_t>(v - begin))};
                farthest = std::max(farthest, length(Vec3d(all.positions[v]) - twin.at(p)));
                const double width =
                    double{desc.root_width} + double{desc.tip_width - desc.root_width} * p / end;
                widest = std::max(widest, std::abs(double{all.widths[v]} - width));
            }
        }
        // coordinates reach 1.6 m: 1e-7 each for storing, some of them for the sums; the waves'
        // phase is in doubles
        CHECK(farthest < 2e-6);
        CHECK(widest < 2e-11);
    }
}

TEST_CASE("strands: the same bits on every instruction set") {
    const std::vector<std::string> sets = instruction_sets();
    REQUIRE(sets.size() > 1);
    for (unsigned number = 0; number < 60; ++number) {
        CAPTURE(number);
        const Hair hair = hair_for(number);
        const StrandDesc desc = desc_for(number, 40);
        std::vector<Drawn> each;
        for (const std::string& set : sets) {
            StrandShape shape(hair.groom, desc, 5, 1 + number % 9, {.instruction_set = set});
            shape.pose(hair.frame);
            each.push_back(drawn(shape));
        }
        for (std::size_t i = 1; i < each.size(); ++i) {
            CAPTURE(sets[i]);
            CHECK(each[i] == each[0]);
        }
    }
}

TEST_CASE("strands: parts of any size, in any order, are the parts of all of them") {
    for (unsigned number = 0; number < 20; ++number) {
        const Hair hair = hair_for(number);
        StrandShape shape(hair.groom, desc_for(number, 150), 5, 1 + number % 5);
        shape.pose(hair.frame);
        const Drawn all = drawn(shape);
        Drawn parts{std::vector<Vec3>(all.positions.size()), std::vector<float>(all.widths.size())};
        std::vector<std::size_t> begins(150 / 3);
        std::iota(begins.begin(), begins.end(), 0);
        std::shuffle(begins.begin(), begins.end(), std::mt19937(number));
        for (const std::size_t b : begins) { // three strands by two calls
            const std::size_t strand[] = {3 * b, 3 * b + 1 + number % 2, 3 * b + 3};
            for (std::size_t i = 0; i < 2; ++i) {
                const std::size_t from = shape.first_vertex(strand[i]),
                                  size = shape.first_vertex(strand[i + 1]) - from;
                shape.fill(strand[i], strand[i + 1] - strand[i],
                           std::span(parts.positions).subspan(from, size),
                           std::span(parts.widths).subspan(from, size));
            }
        }
        CHECK(parts == all);
    }
}

TEST_CASE("strands: what is asked for must be there") {
    const Hair hair = hair_for(1);
    StrandShape shape(hair.groom, desc_for(1, 10), 5);
    std::vector<Vec3> positions(shape.vertex_count());
    std::vector<float> widths(shape.vertex_count());
    CHECK_THROWS_WITH_AS(shape.fill(positions, widths),
                         "strands are drawn before their first frame; pose them first", InputError);
    shape.pose(hair.frame);
    CHECK_THROWS_WITH_AS(shape.fill(9, 2, positions, widths),
                         "strands from 9 on, found 2 of them, expected at most 1", InputError);
    const std::string room = "strands: found room for " + std::to_string(widths.size() - 1) +
                             " widths, expected " + std::to_string(widths.size());
    widths.pop_back();
    CHECK_THROWS_WITH_AS(shape.fill(positions, widths), room.c_str(), InputError);
}

TEST_CASE("curls: the strands turn inside their wisp, and none leaves its place in it (M19)") {
    const Hair hair = straight_hair(6);
    StrandDesc desc;
    desc.count = 30;
    desc.jitter = desc.length_jitter = 0;
    const Curves still = make_strands(hair.groom, hair.frame, desc, 5, 4);
    desc.curls = 2;
    const Curves curled = make_strands(hair.groom, hair.frame, desc, 5, 4);
    REQUIRE(curled.position.size() == still.position.size());
    for (std::size_t v = 0; v < still.position.size(); ++v) {
        const Vec3d a(still.position[v]), b(curled.position[v]);
        // in designed length, 4 segments of 4 cm from x₁ on, the whole of it two turns
        const double turn = 2 * kPi * 2 * (-a.y - 0.04) / 0.16;
        const double along = std::abs(a.x * b.x + a.z * b.z), out = a.x * a.x + a.z * a.z;
        CHECK(b.y == a.y);
        CHECK(b.x * b.x + b.z * b.z == doctest::Approx(out).epsilon(1e-5));
        CHECK(along == doctest::Approx(std::abs(out * cosine(turn))).epsilon(1e-5 + 2e-5));
    }
}
