// The core and the twin over the styles, with all contacts: runs of one second from paired seeds,
// on eight pieces of the built-in motion. What they are like on average has to agree.
//   paired_styles SCENE.toml [seeds [seconds]]

#include "mane/scene.h"
#include "mane/setup.h"
#include "step/paired.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace {

using namespace mane;
using test::Pair, test::Paired;

constexpr double kMotion = 11; // [s] of the built-in motion

/// A motion from a later time on.
class Later final : public Motion {
  public:
    Later(std::shared_ptr<const Motion> motion, double by) : motion_(std::move(motion)), by_(by) {}
    std::size_t bone_count() const override { return motion_->bone_count(); }
    void evaluate(double time, std::span<BonePose> bones) const override {
        motion_->evaluate(time + by_, bones);
    }

  private:
    std::shared_ptr<const Motion> motion_;
    double by_;
};

/// What a run is like: means over its frames.
struct Outcome {
    double energy = 0; ///< kinetic energy per mass [J/kg]
    double radius = 0; ///< over rest
    Vec3d tip;         ///< from its root [m]

    void add(const reference::Hair& hair, double share) {
        double kinetic = 0, mass = 0, radii = 0, points = 0;
        for (const reference::Wisp& wisp : hair.wisps) {
            kinetic += reference::energy(wisp, {}).kinetic;
            for (std::size_t i = 2; i < wisp.sections(); ++i)
                for (std::size_t k = 0; k < wisp.points(); ++k) {
                    mass += wisp.envelope_mass[i] +
                            wisp.skeleton_mass[i] / static_cast<double>(wisp.points());
                    radii += wisp.r[i][k] / wisp.design_radius[i][k];
                    points += 1;
                }
            tip += (wisp.x.back() - wisp.x[1]) * (share / static_cast<double>(hair.wisps.size()));
        }
        energy += share * kinetic / mass;
        radius += share * radii / points;
    }
};

enum Measure { energy, radius, tip_x, tip_y, tip_z, friction, collision, on_body, measure_count };
using Numbers = std::array<double, measure_count>;

Numbers numbers(const Outcome& o, const Statistics& s, int frames) {
    const auto per_frame = [&](std::uint64_t count) { return static_cast<double>(count) / frames; };
    return {o.energy,
            o.radius,
            o.tip.x,
            o.tip.y,
            o.tip.z,
            per_frame(s.friction_contacts),
            per_frame(s.collision_contacts),
            per_frame(s.sliding_contacts)};
}

class Comparison {
  public:
    void run(SceneDesc scene, std::uint32_t seed, double start, int frames) {
        scene.simulation.seed = seed;
        RunSetup setup = prepare(scene);
        setup.bodies[0].motion = std::make_shared<Later>(setup.bodies[0].motion, start);
        Pair pair(scene.simulation, setup.bodies, setup.groom);
        Outcome core, twin;
        for (int frame = 0; frame < frames; ++frame) {
            pair.advance();
            core.add(pair.core_hair(), 1.0 / frames);
            twin.add(pair.twin.hair(), 1.0 / frames);
        }
        const Numbers c = numbers(core, pair.core.statistics(), frames),
                      t = numbers(twin, pair.twin.statistics(), frames);
        for (std::size_t m = 0; m < measure_count; ++m) {
            measures_[m].core.push_back(c[m]);
            measures_[m].twin.push_back(t[m]);
        }
        tips_ += length(twin.tip);
        ++seeds_;
    }

    /// Prints all measures; whether they agree, and are known well enough to say so.
    bool report() {
        for (const Measure m : {tip_x, tip_y, tip_z})
            measures_[m].size = tips_ / seeds_;
        bool good = true;
        for (const Paired& m : measures_) {
            const bool agrees = m.agree(), known = m.standard_error() < 0.03 * m.scale();
            std::printf("%-20s core %10.4g  twin %10.4g  difference %5.2f %%  standard error %5.2f "
                        "%%%s%s\n",
                        m.name.c_str(), Paired::mean(m.core), Paired::mean(m.twin),
                        100 * m.difference() / m.scale(), 100 * m.standard_error() / m.scale(),
                        agrees ? "" : "  DIFFERENT", known ? "" : "  UNCERTAIN");
            good = good && agrees && known;
        }
        return good;
    }

  private:
    std::array<Paired, measure_count> measures_ = {
        {{"kinetic energy/mass"},
         {"radius over rest"},
         {"tip from root, x"}, // relative to the distance, as y and z
         {"tip from root, y"},
         {"tip from root, z"},
         {"quasi-parallel"},
         {"collisions"},
         {"on bodies"}}};
    double tips_ = 0;
    int seeds_ = 0;
};

int run(const char* file, int seeds, double seconds) {
    const SceneDesc scene = read_scene(file);
    const int frames =
        static_cast<int>(seconds * static_cast<double>(scene.simulation.schedule.frame_rate) + 0.5);
    Comparison comparison;
    for (int i = 0; i < seeds; ++i)
        comparison.run(scene, static_cast<std::uint32_t>(i + 1), kMotion * i / seeds, frames);
    std::printf("%s: %d seeds, %d frames each\n", file, seeds, frames);
    if (!comparison.report())
        return 1;
    return std::puts("script test passed"), 0;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return std::fprintf(stderr, "usage: paired_styles SCENE.toml [seeds [seconds]]\n"), 2;
    return run(argv[1], argc > 2 ? std::atoi(argv[2]) : 8, argc > 3 ? std::atof(argv[3]) : 1);
}
