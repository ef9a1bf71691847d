// How far tips swing as the moving head sees them: the core, the twin, and the core with wisps that
// pass through each other, on the built-in motion. The core's swing has to be the twin's to 20 %,
// on average and for nine tips of ten; the latter is what hair without interactions misses.
//   swing SCENE.toml [seconds]

#include "mane/scene.h"
#include "mane/setup.h"
#include "step/paired.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace mane;

/// Peak to peak: the range of every tip along each of the head's axes.
class Swing {
  public:
    explicit Swing(const RunSetup& setup)
        : body_(setup.bodies[0]), low_(setup.groom.wisp_count(), {1e9, 1e9, 1e9}),
          high_(setup.groom.wisp_count(), {-1e9, -1e9, -1e9}) {}

    /// A tip in the world [m] at `time` [s].
    void see(std::size_t wisp, const Vec3d& tip, double time) {
        std::vector<BonePose> bones(body_.motion->bone_count());
        body_.motion->evaluate(time, bones);
        const BonePose& head = bones[body_.head_bone];
        const Vec3d p = head.rotation.conjugate().rotate(tip - head.position);
        Vec3d &low = low_[wisp], &high = high_[wisp];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    /// [m] along the axis on which a tip swings most.
    double of(std::size_t wisp) const {
        const Vec3d range = high_[wisp] - low_[wisp];
        return std::max({range.x, range.y, range.z});
    }
    double mean() const {
        double sum = 0;
        for (std::size_t w = 0; w < low_.size(); ++w)
            sum += of(w) / static_cast<double>(low_.size());
        return sum;
    }

  private:
    const Body& body_;
    std::vector<Vec3d> low_, high_;
};

void see(Swing& swing, const World& world) {
    const Frame& frame = world.frame();
    const Groom& groom = world.groom();
    for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
        const Vec3 tip = frame.position[groom.first_section[w + 1] - 1];
        swing.see(w, Vec3d(tip) + frame.origin, frame.time);
    }
}

void see(Swing& swing, const TwinWorld& world, double time) {
    for (std::size_t w = 0; w < world.hair().wisps.size(); ++w)
        swing.see(w, world.hair().wisps[w].x.back() + world.origin(), time);
}

/// The share of tips whose swing is the other's to 20 %.
double share_within(const Swing& a, const Swing& b, std::size_t wisps) {
    std::size_t within = 0;
    for (std::size_t w = 0; w < wisps; ++w)
        within += std::abs(a.of(w) / b.of(w) - 1) <= 0.2 ? 1 : 0;
    return static_cast<double>(within) / static_cast<double>(wisps);
}

/// All three runs side by side.
struct Swings {
    Swing core, twin, off;
    explicit Swings(const RunSetup& setup) : core(setup), twin(setup), off(setup) {}
};

Swings simulate(const SceneDesc& scene, const RunSetup& setup, double seconds) {
    SimulationDesc without = scene.simulation;
    without.wisps.mode = WispContactMode::off;
    test::Pair pair(scene.simulation, setup.bodies, setup.groom);
    World off(without, setup.groom, setup.bodies);
    Swings swings(setup);
    while (pair.core.frame().time < seconds) {
        pair.advance();
        off.advance();
        see(swings.core, pair.core);
        see(swings.twin, pair.twin, pair.core.frame().time);
        see(swings.off, off);
    }
    return swings;
}

int run(const char* file, double seconds) {
    const SceneDesc scene = read_scene(file);
    const RunSetup setup = prepare(scene);
    const std::size_t wisps = setup.groom.wisp_count();
    const Swings swings = simulate(scene, setup, seconds);
    const double twin = swings.twin.mean();
    std::printf("peak-to-peak swing of %zu tips in %.1f s: the twin %.1f mm on average\n", wisps,
                seconds, 1e3 * twin);
    const auto print = [&](const char* name, const Swing& swing) {
        std::printf("%s: %.1f mm, %.3f of the twin's; %.0f %% of the tips within 20 %%\n", name,
                    1e3 * swing.mean(), swing.mean() / twin,
                    100 * share_within(swing, swings.twin, wisps));
    };
    print("core", swings.core);
    print("core, interactions off", swings.off);
    if (std::abs(swings.core.mean() / twin - 1) > 0.2 ||
        share_within(swings.core, swings.twin, wisps) < 0.9)
        return std::fprintf(stderr, "the core's tips do not swing as the twin's\n"), 1;
    return std::puts("script test passed"), 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return std::fprintf(stderr, "usage: swing SCENE.toml [seconds]\n"), 2;
    return run(argv[1], argc > 2 ? std::atof(argv[2]) : 3);
}
