#include "base/hash.h"
#include "designs.h"
#include "groom/roots.h"
#include "groom/solid.h"
#include "groom/stability.h"
#include "mane/character.h"
#include "mane/error.h"
#include "three_styles.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace mane;
using namespace mane::test;

namespace {

// The bust and its solid, made once.
struct Wearer {
    Body body = make_bust();
    std::vector<std::uint32_t> scalp = bust_scalp(body);
    Solid solid{body.mesh};
};
const Wearer& wearer() {
    static const Wearer w;
    return w;
}

Shape shape_of(const WispDesign& d) {
    return make_shape(std::vector<Vec3d>(d.position.begin(), d.position.end()),
                      Vec3d(d.first_axis));
}

Vec3d envelope_point(const WispDesign& d, const Shape& s, std::size_t i, std::size_t k) {
    const double angle = 2 * 3.14159265358979323846 * double(k) / d.envelope.points;
    return s.position[i] + (s.u[i] * std::cos(angle) + s.v[i] * std::sin(angle)) *
                               double{d.radius[i * d.envelope.points + k]};
}

// M21's test by its definition, K = 4: whether p lies in segment i of a wisp.
bool inside(const Vec3d& p, const WispDesign& d, const Shape& s, std::size_t i) {
    const double h0 = dot(p - s.position[i], s.normal[i]),
                 h1 = dot(s.position[i + 1] - p, s.normal[i + 1]);
    if (h0 * h1 < 0 || h0 + h1 == 0)
        return false;
    const double t = h0 / (h0 + h1);
    const auto mixed = [&](const auto& a, const auto& b) { return a * (1 - t) + b * t; };
    const Vec3d off = p - mixed(s.position[i], s.position[i + 1]);
    const double x = dot(off, mixed(s.u[i], s.u[i + 1])), y = dot(off, mixed(s.v[i], s.v[i + 1]));
    const auto radius = [&](std::size_t k) {
        return mixed(double{d.radius[4 * i + k]}, double{d.radius[4 * i + 4 + k]});
    };
    const double a = x / radius(x >= 0 ? 0 : 2), b = y / radius(y >= 0 ? 1 : 3);
    return a * a + b * b <= 1;
}

// Other segments that a segment intersects, mean over the hair, by brute force.
double intersections_per_segment(const std::vector<WispDesign>& wisps) {
    struct Segment {
        std::size_t wisp, index;
        std::vector<Vec3d> points;
        Vec3d centre;
        double reach;
    };
    std::vector<Shape> shapes;
    std::vector<Segment> segments;
    for (std::size_t w = 0; w < wisps.size(); ++w) {
        shapes.push_back(shape_of(wisps[w]));
        const Shape& s = shapes.back();
        for (std::size_t i = 1; i < s.segments(); ++i) {
            Segment g{w, i, {}, (s.position[i] + s.position[i + 1]) / 2, 0};
            for (std::size_t end : {i, i + 1}) {
                g.points.push_back(s.position[end]);
                for (std::size_t k = 0; k < 4; ++k)
                    g.points.push_back(envelope_point(wisps[w], s, end, k));
            }
            for (const Vec3d& p : g.points)
                g.reach = std::max(g.reach, length(p - g.centre));
            segments.push_back(g);
        }
    }
    const auto reaches = [&](const Segment& a, const Segment& b) {
        return std::any_of(a.points.begin(), a.points.end(), [&](const Vec3d& p) {
            return inside(p, wisps[b.wisp], shapes[b.wisp], b.index);
        });
    };
    double pairs = 0;
    for (std::size_t a = 0; a < segments.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const Segment &p = segments[a], &q = segments[b];
            if (p.wisp == q.wisp && p.index - q.index < 2)
                continue; // they share a section
            if (length(p.centre - q.centre) > 2 * (p.reach + q.reach))
                continue;
            pairs += reaches(p, q) || reaches(q, p) ? 1 : 0;
        }
    return 2 * pairs / double(segments.size());
}

std::uint64_t hash(const Groom& g) {
    StateHash h;
    for (const Vec3& p : g.position)
        h.add(p.x), h.add(p.y), h.add(p.z);
    for (const auto* values : {&g.radius, &g.rest_radius, &g.rest_length, &g.rest_curvature_u,
                               &g.rest_curvature_v, &g.bend_stiffness, &g.radial_stiffness})
        h.add(*values);
    return h.value();
}

} // namespace

TEST_CASE("roots are spread evenly over the scalp") {
    const auto everywhere = [](const ScalpPoint&) { return true; };
    const auto stay = [](const ScalpPoint&) { return Vec3d(); };
    const std::vector<ScalpPoint> roots =
        spread_roots(wearer().body.mesh, wearer().scalp, 100, 1, everywhere, stay);
    REQUIRE(roots.size() == 100);
    double area = 0;
    for (std::uint32_t t : wearer().scalp) {
        const auto& v = wearer().body.mesh.triangles[t];
        const Vec3d a(wearer().body.mesh.vertices[v[0]]);
        area += length(cross(Vec3d(wearer().body.mesh.vertices[v[1]]) - a,
                             Vec3d(wearer().body.mesh.vertices[v[2]]) - a)) /
                2;
    }
    // Points at random come within 0.1 of the spacing of a hexagonal lattice; these keep over half
    // of it.
    const double lattice = std::sqrt(area / 100 * 2 / std::sqrt(3.0));
    for (std::size_t i = 0; i < roots.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            CHECK(length(roots[i].position - roots[j].position) > 0.5 * lattice);
    for (const ScalpPoint& r : roots) {
        CHECK(std::binary_search(wearer().scalp.begin(), wearer().scalp.end(), r.triangle));
        CHECK(std::fabs(wearer().solid.clearance(r.position).distance) < 1e-7);
    }
}

TEST_CASE("the three styles: counts, means, smooth curves, outside the body, steps of 1 ms") {
    for (const NamedStyle& style : three_styles()) {
        CAPTURE(std::string(style.name));
        const std::vector<WispDesign> wisps = lay_style(style.hair, wearer().body, wearer().scalp);
        CHECK(wisps.size() == style.hair.style.wisps);
        std::size_t segments = 0, strands = 0, held = 0;
        double sharpest = 1, nearest = 1, deepest = 1;
        for (const WispDesign& d : wisps) {
            segments += d.position.size() - 2;
            strands += d.strands;
            held += d.skeleton.bending_length > style.hair.skeleton.bending_length;
            const Shape s = shape_of(d);
            CHECK(wearer().solid.clearance(s.position[0]).distance < 0);
            for (std::size_t i = 1; i < s.segments(); ++i) {
                sharpest = std::min(sharpest, dot(s.tangent[i - 1], s.tangent[i]));
                for (double t : {0.0, 0.25, 0.5, 0.75, 1.0})
                    nearest = std::min(
                        nearest,
                        wearer()
                            .solid.clearance(s.position[i] * (1 - t) + s.position[i + 1] * t)
                            .distance);
                for (std::size_t k = 0; k < 4; ++k)
                    deepest = std::min(
                        deepest, wearer().solid.clearance(envelope_point(d, s, i, k)).distance);
            }
        }
        CHECK(std::fabs(double(segments) / double(wisps.size()) - style.segments) <=
              0.5 / double(wisps.size()));
        CHECK(strands == style.hair.strands.count);
        CHECK(sharpest >
              std::cos(45 * 3.14159 /
                       180)); // the tightest way over a head or a shoulder in steps of 5.5 cm
        CHECK(nearest > 0.002);
        CHECK(deepest > 0);
        const Groom groom = make_groom(wisps, wearer().body.mesh);
        const StepLimit limit = step_limit(groom, 3);
        CHECK(limit.step > 0.001); // 1000 Hz (M36)
        const double intersections = intersections_per_segment(wisps);
        MESSAGE(std::string(style.name)
                << ": " << intersections << " intersections per segment in the design, " << held
                << " wisps held, largest step " << limit.step * 1e3 << " ms by "
                << limit.parameter);
        CHECK(intersections > 0.5 * style.intersections);
        CHECK(intersections < 2 * style.intersections);
    }
}

TEST_CASE(
    "the same style is the same to the last bit; another seed is another head of the same hair") {
    for (const NamedStyle& style : three_styles()) {
        const auto once = [&](std::uint32_t seed) {
            return hash(make_groom(lay_style(style.hair, wearer().body, wearer().scalp, seed),
                                   wearer().body.mesh));
        };
        const std::uint64_t first = once(1);
        CHECK(once(1) == first);
        CHECK(once(2) != first);
    }
}

TEST_CASE("styles that cannot be laid are said") {
    HairDesc hair;
    CHECK_THROWS_WITH_AS(lay_style(hair, wearer().body, {}), doctest::Contains("no scalp"),
                         InputError);
    hair.style.hairline = 0.2f;
    CHECK_THROWS_WITH_AS(lay_style(hair, wearer().body, wearer().scalp),
                         doctest::Contains("room for 0 of 56 wisps"), InputError);
    hair.style.wisps = 0;
    CHECK_THROWS_WITH_AS(lay_style(hair, wearer().body, wearer().scalp),
                         doctest::Contains("style.wisps is 0"), InputError);
}
