// Two runs of a style side by side, of which one asks for every section what it touches: the same
// contacts with the bodies at every detection and the same state after every block, to the bit.
//   clear_regions SCENE.toml [seconds]

#include "mane/scene.h"
#include "mane/setup.h"
#include "step/cast.h"
#include "step/placement.h"
#include "step/roots.h"
#include "step/step.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace mane;

bool same(const SlidingContact& a, const SlidingContact& b) {
    return a.point.section == b.point.section && a.point.along == b.point.along &&
           a.point.k == b.point.k && a.point.alpha == b.point.alpha &&
           a.point.beta == b.point.beta && a.body == b.body && a.triangle == b.triangle &&
           a.anchor == b.anchor && a.anchor_change == b.anchor_change && a.normal == b.normal &&
           a.normal_change == b.normal_change && a.threshold == b.threshold;
}

bool same(const Rows& a, const Rows& b) {
    return std::equal(a.all().begin(), a.all().end(), b.all().begin(), b.all().end());
}
bool same(const State& a, const State& b) {
    return same(a.position, b.position) && same(a.velocity, b.velocity) &&
           same(a.radius, b.radius) && same(a.radius_rate, b.radius_rate);
}

/// The bodies' frames and the origin move as in a World.
class Pair {
  public:
    explicit Pair(const RunSetup& setup, const SimulationDesc& desc)
        : cast_(setup.bodies), runs_{Simulation(desc, setup.groom, {}),
                                     Simulation(desc, setup.groom, {})} {
        runs_[1].character_contacts = CharacterContacts({.clear_regions = false});
        const Vec3d origin = cast_.on_head(Vec3d(setup.groom.position[1]), 0);
        cast_.begin(0, origin);
        for (Simulation& run : runs_) {
            run.origin = origin;
            run.bodies = cast_.contact_bodies();
            place_groom(run, cast_, 0);
        }
    }

    /// False once anything is not the same.
    bool advance() {
        const Schedule& schedule = runs_[0].schedule;
        const std::uint64_t first = frame_++ * schedule.steps();
        const auto time = [&](std::uint64_t step) {
            return static_cast<double>(first + step) * schedule.step_seconds();
        };
        cast_.begin(time(0), runs_[0].origin);
        for (std::uint32_t b = 0; b < schedule.blocks(); ++b) {
            const std::uint32_t begin = schedule.block_begin(b), end = schedule.block_begin(b + 1);
            enter_block(time(begin), (end - begin) * schedule.step_seconds());
            StepPlace place{
                .index = 0, .steps = end - begin, .detects_wisps = schedule.detects_wisps(b)};
            for (; place.index < place.steps; ++place.index) {
                for (Simulation& run : runs_)
                    step(run, place, time(begin + place.index));
                if (place.first() && !same_contacts())
                    return false;
            }
            if (!same(runs_[0].state, runs_[1].state))
                return false;
        }
        return true;
    }

    const Statistics& statistics() const { return runs_[0].statistics; }

  private:
    void enter_block(double time, double seconds) {
        const auto follow = [&](int end) {
            for (Simulation& run : runs_)
                follow_scalp(run.groom, run.layout, cast_.body(0).mesh, cast_.vertices(0),
                             cast_.velocities(0), end, run.roots);
        };
        for (Simulation& run : runs_)
            run.roots.seconds = static_cast<float>(seconds);
        follow(0);
        cast_.advance(time + seconds, seconds, runs_[0].origin);
        follow(1);
    }

    bool same_contacts() const {
        for (std::size_t w = 0; w < runs_[0].groom.wisp_count(); ++w) {
            const auto a = runs_[0].character_contacts.of_wisp(w),
                       b = runs_[1].character_contacts.of_wisp(w);
            if (!std::equal(a.begin(), a.end(), b.begin(), b.end(),
                            [](const auto& x, const auto& y) { return same(x, y); }))
                return false;
        }
        return true;
    }

    Cast cast_;
    std::array<Simulation, 2> runs_;
    std::uint64_t frame_ = 0;
};

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return std::fprintf(stderr, "usage: clear_regions SCENE.toml [seconds]\n"), 2;
    const SceneDesc scene = read_scene(argv[1]);
    const double seconds = argc > 2 ? std::atof(argv[2]) : 11;
    Pair pair(prepare(scene), scene.simulation);
    const int frames = static_cast<int>(seconds * double{scene.simulation.schedule.frame_rate});
    for (int frame = 0; frame < frames; ++frame)
        if (!pair.advance())
            return std::fprintf(stderr, "not the same in frame %d\n", frame), 1;
    const Statistics& s = pair.statistics();
    std::printf("the same %llu sliding contacts and %llu reactions at %llu detections\n",
                static_cast<unsigned long long>(s.sliding_contacts),
                static_cast<unsigned long long>(s.penetration_reactions),
                static_cast<unsigned long long>(s.character_detections));
    return s.sliding_contacts > 0 ? 0 : 1;
}
