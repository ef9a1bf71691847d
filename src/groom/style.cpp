#include "mane/style.h"
#include "base/functions.h"
#include "base/random.h"
#include "groom/balance.h"
#include "groom/comb.h"
#include "groom/grow.h"
#include "groom/roots.h"
#include "groom/sections.h"
#include "groom/solid.h"
#include "mane/error.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace mane {
namespace {

enum RandomNumber : std::uint64_t { length_number, turn_number };

// Lengths from nape to crown, each a little shorter at random.
double wisp_length(const StyleDesc& style, const ScalpExtent& extent, const ScalpPoint& root,
                   const Random& random) {
    const double height = std::clamp(extent.height(root.position.y), 0.0, 1.0);
    const double full =
        style.nape_length + (double{style.crown_length} - style.nape_length) * height;
    return full * (1 - double{style.length_variation} * random.unit(length_number));
}

// Whole numbers of segments, in proportion to the lengths, with exactly the wanted mean: the
// largest remainders are rounded up.
std::vector<std::uint32_t> share_segments(const std::vector<double>& lengths, double mean) {
    const auto count = lengths.size();
    const auto total =
        static_cast<std::size_t>(std::floor(mean * static_cast<double>(count) + 0.5));
    const double all = std::accumulate(lengths.begin(), lengths.end(), 0.0);
    std::vector<std::uint32_t> segments(count);
    std::vector<double> left(count);
    std::size_t given = 0;
    for (std::size_t w = 0; w < count; ++w) {
        const double fair = static_cast<double>(total) * lengths[w] / all;
        segments[w] = std::max(1u, static_cast<std::uint32_t>(fair));
        left[w] = fair - segments[w];
        given += segments[w];
    }
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return left[a] > left[b]; });
    for (std::size_t i = 0; given < total; ++i, ++given)
        ++segments[order[i % count]];
    return segments;
}

void check(const StyleDesc& style, std::span<const std::uint32_t> scalp) {
    if (scalp.empty())
        throw InputError("the style has no scalp: expected at least one triangle to grow hair on");
    if (style.wisps == 0)
        throw InputError("style.wisps is 0; expected at least 1");
    if (style.segments < 1)
        throw InputError("style.segments is " + std::to_string(style.segments) +
                         "; expected at least 1");
}

double area(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
    double sum = 0;
    for (std::uint32_t t : triangles) {
        const auto& v = mesh.triangles[t];
        const Vec3d a(mesh.vertices[v[0]]), b(mesh.vertices[v[1]]), c(mesh.vertices[v[2]]);
        sum += length(cross(b - a, c - a)) / 2;
    }
    return sum;
}

bool is_far_from(const std::vector<Vec3d>& border, const Vec3d& p, double least) {
    return std::all_of(border.begin(), border.end(),
                       [&](const Vec3d& b) { return length(b - p) >= least; });
}

std::vector<ScalpPoint> style_roots(const StyleDesc& style, const Body& wearer,
                                    std::span<const std::uint32_t> scalp, const Comb& comb,
                                    std::uint32_t seed) {
    const std::vector<Vec3d> border = region_border(wearer.mesh, scalp);
    const auto accept = [&](const ScalpPoint& p) {
        return !comb.on_parting(p) && is_far_from(border, p.position, style.hairline);
    };
    // A wisp covers the scalp after its root, so roots stand at the beginning of their share of it.
    const double share = 0.4 * std::sqrt(area(wearer.mesh, scalp) / style.wisps);
    const auto upstream = [&](const ScalpPoint& p) {
        const Vec3d along = comb.direction(p.position, p.position, p.normal, 1);
        return normalized(along - p.normal * dot(along, p.normal)) * -share;
    };
    std::vector<ScalpPoint> roots =
        spread_roots(wearer.mesh, scalp, style.wisps, seed, accept, upstream);
    if (roots.size() < style.wisps)
        throw InputError("style: room for " + std::to_string(roots.size()) + " of " +
                         std::to_string(style.wisps) +
                         " wisps; a smaller style.hairline or style.parting_width would do");
    return roots;
}

// Hair that would fall out of its style, or hang in it by springs wound up so far that a push would
// let it snap over to the other side, gets the bending length that would do, as if it were set. Its
// bending damping stays what it is in N·m·s, in proportion to ζ b^3.5: more stiffness must not ask
// for shorter steps.
void hold(WispDesign& wisp) {
    constexpr double kMostDroop = 1.0; // [rad]
    const Vec3d gravity{0, -kStandardGravity, 0};
    const double own = wisp.skeleton.bending_length;
    const double standing = standing_bending_length(wisp, gravity);
    double enough = standing > own ? 1.1 * standing : own;
    // Stiffness goes with the cube of the bending length; weight does not change with it.
    enough = std::max(enough, own * power(largest_droop(wisp, gravity) / kMostDroop, 1.0 / 3));
    if (enough == own)
        return;
    wisp.skeleton.bending_length = static_cast<float>(enough);
    wisp.skeleton.bending_damping *= static_cast<float>(power(own / enough, 3.5));
}

} // namespace

std::vector<WispDesign> lay_style(const HairDesc& hair, const Body& wearer,
                                  std::span<const std::uint32_t> scalp, std::uint32_t seed) {
    const StyleDesc& style = hair.style;
    check(style, scalp);
    const ScalpExtent extent = scalp_extent(wearer.mesh, scalp);
    const Solid body(wearer.mesh);
    const Grower grower(style, extent, body);
    const std::vector<ScalpPoint> roots = style_roots(style, wearer, scalp, grower.comb(), seed);

    std::vector<double> lengths;
    for (std::size_t w = 0; w < roots.size(); ++w)
        lengths.push_back(wisp_length(style, extent, roots[w], Random(seed, w)));
    const std::vector<std::uint32_t> segments = share_segments(lengths, style.segments);

    std::vector<WispDesign> wisps;
    for (std::size_t w = 0; w < roots.size(); ++w) {
        const double most = double{style.variation} * kPi / 180;
        const double turn = Random(seed, w).between(turn_number, static_cast<float>(-most),
                                                    static_cast<float>(most));
        WispDesign wisp = cut_sections(style, hair.envelope, roots[w],
                                       grower.grow(roots[w], lengths[w], turn), segments[w], body);
        wisp.strands = static_cast<std::uint32_t>((w + 1) * hair.strands.count / roots.size() -
                                                  w * hair.strands.count / roots.size());
        wisps.push_back(std::move(wisp));
    }
    give_springs(wisps, hair);
    return wisps;
}

void give_springs(std::span<WispDesign> wisps, const HairDesc& hair) {
    for (WispDesign& wisp : wisps) {
        wisp.skeleton = hair.skeleton;
        wisp.envelope = hair.envelope;
        hold(wisp);
    }
}

} // namespace mane
