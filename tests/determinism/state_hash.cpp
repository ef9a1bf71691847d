// Prints the state hash of a run in which everything happens, and compares it with the golden one:
// a program of its own and not a test case, so that node can run it too (M39).
//   state_hash GOLDEN_FILE [instruction set] [threads]

#include "mane/style.h"
#include "mane/world.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

using namespace mane;

/// A head that shakes and nods while it walks, in closed form and exact operations only.
class Shake final : public Motion {
  public:
    std::size_t bone_count() const override { return 1; }
    void evaluate(double time, std::span<BonePose> bones) const override {
        // q turns about a fixed axis by twice the angle whose tangent is `a`: a rotation without
        // trigonometry.
        const double phase = time * 2.5 - static_cast<double>(static_cast<long>(time * 2.5));
        const double wave = 16 * phase * phase * (1 - phase) * (1 - phase),
                     slope = 2.5 * 32 * phase * (1 - phase) * (1 - 2 * phase);
        const double a = 0.4 * wave, n = 1 / (1 + a * a);
        bones[0].rotation = normalized(Quatd{0.2 * a, a, 0, 1});
        bones[0].angular_velocity = Vec3d{0.2, 1, 0} * (2 * 0.4 * slope * n);
        bones[0].position = {0.8 * time, 0.05 * wave, 0};
        bones[0].velocity = {0.8, 0.05 * slope, 0};
    }
};

/// Straight wisps of all lengths in a bundle that crosses itself.
std::vector<WispDesign> bundle(const Mesh& peg) {
    std::vector<WispDesign> wisps;
    for (std::uint32_t i = 0; i < 21; ++i) {
        StraightWisp wisp;
        wisp.segments = 3 + i % 7;
        wisp.length = 0.25f + 0.01f * static_cast<float>(i);
        wisp.radius = {0.02f, 0.008f};
        WispDesign one = design(wisp, peg);
        const Vec3 offset{static_cast<float>(i % 5) * 0.02f - 0.04f, 0,
                          static_cast<float>(i / 5) * 0.02f - 0.04f};
        for (Vec3& p : one.position)
            p += offset;
        wisps.push_back(one);
    }
    return wisps;
}

int run(const std::string& golden_file, const RunOptions& options) {
    Body peg = make_peg(0.2f);
    peg.motion = std::make_shared<Shake>();
    SimulationDesc desc;
    desc.air.wind = {1, 0, 0.5f};
    desc.air.gusts = 1;
    desc.wisps.axis_contact_ratio = 0.5f;
    World world(desc, make_groom(bundle(peg.mesh), peg.mesh), {peg}, 0, options);
    for (int i = 0; i < 48; ++i)
        world.advance();

    const Statistics& s = world.statistics();
    char mine[17];
    std::snprintf(mine, sizeof mine, "%016" PRIx64, world.state_hash());
    std::printf("%s, %u threads: %s after %" PRIu64 " steps, %" PRIu64 " friction and %" PRIu64
                " collision contacts\n",
                world.instruction_set(), options.threads, mine, s.steps, s.friction_contacts,
                s.collision_contacts);
    std::string golden;
    std::ifstream(golden_file) >> golden;
    if (golden == mine)
        return std::puts("script test passed"), 0;
    std::fprintf(stderr, "the state hash is %s; expected %s\n", mine, golden.c_str());
    return 1;
}

} // namespace

int main(int argc, char** argv) {
    constexpr int kSkipped = 77;
    if (argc < 2)
        return std::fprintf(stderr,
                            "usage: state_hash GOLDEN_FILE [instruction set|best] [threads]\n"),
               2;
    RunOptions options;
    if (argc > 2 && std::string(argv[2]) != "best")
        options.instruction_set = argv[2];
    options.threads = argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1;
    try {
        return run(argv[1], options);
    } catch (const InputError& error) {
        return std::printf("skipped: %s\n", error.what()), kSkipped;
    }
}
