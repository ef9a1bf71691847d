/// Contact with a whole character: the built-in bust in its quickest motion.

#include "bodies/brute_surface.h"
#include "character/skinning.h"
#include "interactions/toy_hair.h"
#include "mane/character.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace mane;
using namespace mane::test;

namespace {

constexpr int kWisps = 24, kSegments = 9;
constexpr double kBlock = 1.0 / 120;

struct Root {
    Vec3d inside, outside; ///< [m] x₀ and x₁ in the rest pose
};

/// Wisps from all over the scalp, laid over the bust at two centimetres from it.
struct Wearer {
    Body bust = make_bust();
    std::shared_ptr<const Motion> motion = builtin_motion();
    std::vector<BonePose> bones = std::vector<BonePose>(motion->bone_count());
    std::vector<Root> roots;
    std::vector<std::vector<Vec3>> wisps;

    Wearer() {
        const Surface surface(bust.mesh);
        const std::vector<std::uint32_t> scalp = bust_scalp(bust);
        for (std::size_t w = 0; w < kWisps; ++w) {
            const std::uint32_t t = scalp[w * scalp.size() / kWisps];
            const Triangle corners = surface.start().triangle(t);
            const Vec3d centre = (corners.a + corners.b + corners.c) / 3.0;
            const Vec3d normal = surface.start().normal(t);
            roots.push_back({centre - normal * 0.005, centre + normal * 0.005});
            wisps.push_back(lay(surface, roots.back(), normal));
        }
    }

    static std::vector<Vec3> lay(const Surface& surface, const Root& root, Vec3d way) {
        std::vector<Vec3> points{Vec3(root.inside), Vec3(root.outside)};
        for (int i = 0; i < kSegments; ++i) {
            way = normalized(way + Vec3d{0, -0.45, -0.1});
            Vec3d p = Vec3d(points.back()) + way * 0.035;
            const auto place = surface.start().nearest(p, 1);
            if (surface.start().inside(p) || place->closest.squared < 0.02 * 0.02)
                p = place->closest.point + surface.start().normal(place->triangle) * 0.02;
            points.emplace_back(p);
        }
        return points;
    }

    std::vector<Vec3> pose(double time) {
        std::vector<Vec3> positions(bust.mesh.vertices.size()), velocities(positions.size());
        motion->evaluate(time, bones);
        pose_mesh(bust, bones, {}, positions, velocities);
        return positions;
    }

    Vec3d on_head(double time, const Vec3d& rest) {
        motion->evaluate(time, bones);
        return bones[kHeadBone].rotation.rotate(rest) + bones[kHeadBone].position;
    }

    void move_roots(ToyHair& hair, double time) {
        for (std::uint32_t w = 0; w < kWisps; ++w) {
            for (std::uint32_t i : {0u, 1u}) {
                const Vec3d& rest = i == 0 ? roots[w].inside : roots[w].outside;
                const Vec3d from = on_head(time, rest), to = on_head(time + kBlock, rest);
                hair.state.position.set(hair.slot(w, i), Vec3(from));
                hair.state.velocity.set(hair.slot(w, i), Vec3((to - from) / kBlock));
            }
        }
        hair.find_frames();
    }
};

} // namespace

TEST_CASE("through the built-in motion's whirl, started from rest, no point or axis stays inside") {
    Wearer wearer;
    ToyHair hair(wearer.wisps, 4, 0.012f);
    ToyRun run(hair, {wearer.bust.mesh});
    run.stretch = 40000;
    run.rest_length = 0.035f;
    run.spring = 1;
    run.spring_length = 0.012f;
    run.air = 3;
    run.dt = static_cast<float>(kBlock) / 8;

    const ClosedMesh closed = close_borders(wearer.bust.mesh);
    const double start = 4.8; // the whirl's first second
    int inside = 0, through = 0;
    float fastest = 0;
    for (int b = 0; b < 120; ++b) {
        const double time = start + b * kBlock;
        wearer.move_roots(hair, time);
        const std::vector<Vec3> from = wearer.pose(time), to = wearer.pose(time + kBlock);
        std::size_t vertex = 0;
        run.block([&](std::size_t, double t, const Vec3d&) {
            const auto& pose = b == 0 && t == 0 ? from : to;
            return Vec3d(pose[vertex++ % pose.size()]);
        });
        for (std::uint32_t w = 0; w < kWisps; ++w) {
            for (std::uint32_t i = 2; i < kSegments + 2; ++i) {
                const Vec3d p(hair.x(w, i)), before(hair.x(w, i - 1));
                through += run.surfaces[0]->end().crosses(before, p);
                fastest = std::max(fastest, length(hair.v(w, i)));
                // the slow twin at every tenth block
                if (b % 10 == 0)
                    inside += winding_number(closed, closed_vertices(closed, to), p) > 0.5;
            }
        }
    }
    CHECK(inside == 0);
    CHECK(through == 0);
    CHECK(run.reactions > 0);
    CHECK(fastest > 0.5f); // it did whirl
}
