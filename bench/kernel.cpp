// Skeleton and envelope alone as a case of `mane bench --kernel`: forces and positions step after
// step, on a groom that hangs from a still head and touches nothing, so that nothing but their own
// rows is in the caches.
//   bench_kernel bench-one '{"scene": "long.toml", "instruction_set": "", "most_frames": 24}'

#include "base/hash.h"
#include "case_program.h"
#include "mane/scene.h"
#include "mane/setup.h"
#include "step/placement.h"
#include "step/roots.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace {

using namespace mane;
using Json = nlohmann::ordered_json;

/// The groom as it was designed, under a head that does not move.
class HangingHair {
  public:
    HangingHair(const SceneDesc& scene, const std::string& instruction_set)
        : setup_(prepare(scene)),
          simulation_(scene.simulation, setup_.groom, RunOptions{1, instruction_set, {}}) {
        Cast cast(setup_.bodies);
        simulation_.origin = cast.on_head(Vec3d(setup_.groom.position[1]), 0);
        cast.begin(0, simulation_.origin);
        place_groom(simulation_, cast, 0);
        simulation_.roots.seconds = static_cast<float>(simulation_.schedule.step_seconds());
        const std::vector<Vec3> still(cast.vertices(0).size());
        for (const int end : {0, 1})
            follow_scalp(simulation_.groom, simulation_.layout, cast.body(0).mesh, cast.vertices(0),
                         still, end, simulation_.roots);
    }

    void step() {
        const KernelData data = simulation_.kernel_data();
        const auto run = [&](StageTime& time, const auto& work) {
            const auto begin = Clock::now();
            simulation_.for_packets(work);
            time += Clock::now() - begin;
        };
        run(forces_, [&](std::size_t first, std::size_t last) {
            simulation_.kernels.process_forces(data, first, last);
        });
        run(positions_, [&](std::size_t first, std::size_t last) {
            simulation_.kernels.process_positions(data, 1, first, last);
        });
        ++steps_;
    }
    void forget_times() {
        forces_ = positions_ = {};
        steps_ = 0;
    }

    Json figures() const {
        const double rows = packet_rows() * static_cast<double>(steps_);
        const double forces = 1e9 * forces_.count() / rows,
                     positions = 1e9 * positions_.count() / rows;
        return {{"threads", 1},
                {"instruction_set", simulation_.kernels.instruction_set},
                {"wisps", setup_.groom.wisp_count()},
                {"packet_rows", packet_rows()},
                {"steps", steps_},
                {"cost",
                 {{"forces_per_packet", forces},
                  {"positions_per_packet", positions},
                  {"kernel_per_packet", forces + positions}}},
                {"state_hash", hash()}};
    }

  private:
    using Clock = std::chrono::steady_clock;
    using StageTime = std::chrono::duration<double>;

    /// Simulated sections of all packets, each sixteen wide.
    double packet_rows() const {
        double rows = 0;
        for (const Packet& packet : simulation_.layout.packets())
            rows += packet.rows - 2;
        return rows;
    }
    std::string hash() const {
        StateHash hash;
        for (std::uint32_t s = 0; s < setup_.groom.section_count(); ++s) {
            const Vec3 x = simulation_.state.position.vec(simulation_.layout.slot(s));
            for (const float c : {x.x, x.y, x.z})
                hash.add(c);
        }
        char text[17];
        std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
        return text;
    }

    RunSetup setup_;
    Simulation simulation_;
    StageTime forces_{}, positions_{};
    std::size_t steps_ = 0;
};

Json measure(const Json& c) {
    const SceneDesc scene = read_scene(c["scene"].get<std::string>());
    HangingHair hair(scene, c["instruction_set"]);
    const std::uint32_t steps =
        Schedule(scene.simulation.schedule).steps() *
        std::min<std::uint32_t>(scene.simulation.schedule.frames, c["most_frames"]);
    for (std::uint32_t i = 0; i < steps / 4; ++i) // into the caches
        hair.step();
    hair.forget_times();
    for (std::uint32_t i = 0; i < steps; ++i)
        hair.step();
    Json figures = hair.figures();
    figures["scene"] = c["scene"];
    return figures;
}

} // namespace

int main(int argc, char** argv) {
    return mane::run_case(argc, argv, measure);
}
