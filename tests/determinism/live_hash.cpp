// Prints the state hash of a run that a host plays with: a head led by jerky poses, parameters,
// hair and rates that change, pins, teleports; and one of the strands of its last frame; and
// compares them with the golden ones (M39, M46).
//   live_hash GOLDEN_FILE [instruction set|best] [threads]
//   live_hash --print

#include "mane/driven.h"
#include "mane/strands.h"
#include "mane/style.h"
#include "mane/world.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

namespace {

using namespace mane;

constexpr int kFrames = 96;

/// Numbers from −1 to 1, the same everywhere.
class Jerks {
  public:
    double next() {
        state_ = state_ * 6364136223846793005u + 1442695040888963407u;
        return static_cast<double>(state_ >> 40) / (1 << 23) - 1;
    }

  private:
    std::uint64_t state_ = 7;
};

struct Player {
    Body bust = make_bust();
    std::vector<WispDesign> designs;
    std::shared_ptr<DrivenBust> head = std::make_shared<DrivenBust>();
    Jerks jerks;

    Player() {
        HairDesc hair;
        hair.style.wisps = 37; // two packets and a bit
        designs = lay_style(hair, bust, bust_scalp(bust));
        bust.motion = head;
    }
    Groom groom(float radius, float strain) const {
        std::vector<WispDesign> other = designs;
        for (WispDesign& wisp : other) {
            wisp.skeleton.strain = strain;
            for (float& r : wisp.radius)
                r *= radius;
        }
        return make_groom(other, bust.mesh);
    }
    void lead(const World& world) {
        HeadPose pose = head->target();
        // in braces, which are worked out from left to right
        pose.position += Vec3d{jerks.next(), jerks.next(), jerks.next()} * 0.01;
        pose.rotation = pose.rotation * Quatd{0.1 * jerks.next(), 0.2 * jerks.next(), 0, 1};
        pose.chest = pose.chest * Quatd{0, 0.05 * jerks.next(), 0, 1};
        head->move_to(pose, world.frame().time, world.next_time());
    }
    void play(World& world, int frame);
};

void Player::play(World& world, int frame) {
    SimulationDesc desc = world.desc();
    const Groom& now = world.groom();
    switch (frame) {
    case 8:
        desc.air.wind = {2, 0, 1};
        desc.air.gusts = 1.5f;
        desc.gravity = {1, -8, 0};
        return world.change(desc);
    case 16:
        return world.change(groom(1.2f, 0.008f));
    case 24:
        world.pin({.section = now.first_section[5] + 4});
        return world.pin({.section = now.first_section[20] - 1, .body = 0, .bone = kHeadBone});
    case 32:
        desc.schedule.integration_rate = 1400;
        desc.schedule.character_rate = 200;
        desc.schedule.frame_rate = 30;
        return world.change(desc);
    case 40:
        head->jump({{3, 1, -2}, {0.1, 0.7, 0.2, 0.5}});
        return world.teleport();
    case 48:
        desc.wisps.friction = 40;
        desc.wisps.parallel_angle = 45;
        desc.wisps.axis_contact_ratio = 0.5f;
        desc.character.friction = 20;
        return world.change(desc, groom(0.9f, 0.006f));
    case 56:
        return world.pin({.section = now.first_section[5] + 4,
                          .place = world.frame().origin + Vec3d(0.2, 0.1, -0.2),
                          .ease = 0.5});
    case 64:
        return world.release(now.first_section[20] - 1);
    case 72:
        return world.release(now.first_section[5] + 4);
    default:
        return;
    }
}

/// Over every bit of the strands' vertices, waves and curls on.
std::uint64_t strand_hash(const World& world, const RunOptions& options) {
    StrandDesc desc;
    desc.count = 1000;
    desc.waves = 3;
    desc.wave_amplitude = 0.2f;
    desc.curls = 1.5f;
    StrandShape shape(world.groom(), desc, 1, 4,
                      {.threads = options.threads, .instruction_set = options.instruction_set});
    shape.pose(world.frame());
    std::vector<Vec3> positions(shape.vertex_count());
    std::vector<float> widths(shape.vertex_count());
    shape.fill(positions, widths);
    std::uint64_t hash = 0xcbf29ce484222325u; // FNV-1a, by numbers
    const auto add = [&](float x) {
        hash = (hash ^ __builtin_bit_cast(std::uint32_t, x)) * 0x100000001b3u;
    };
    for (const Vec3& p : positions)
        add(p.x), add(p.y), add(p.z);
    for (float w : widths)
        add(w);
    return hash;
}

std::string hex(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, hash);
    return text;
}

/// The golden file's line.
std::string simulate(const RunOptions& options) {
    Player player;
    SimulationDesc desc;
    World world(desc, player.groom(1, 0.006f), {player.bust}, 0, options);
    for (int frame = 0; frame < kFrames; ++frame) {
        player.play(world, frame);
        player.lead(world);
        world.advance();
    }
    std::fprintf(stderr, "%s, %u threads\n", world.instruction_set(), options.threads);
    return hex(world.state_hash()) + " " + hex(strand_hash(world, options));
}

int compare(const std::string& golden_file, const RunOptions& options) {
    std::ifstream in(golden_file);
    std::string golden;
    std::getline(in, golden);
    const std::string mine = simulate(options);
    if (mine == golden)
        return std::puts("script test passed"), 0;
    return std::fprintf(stderr, "the hashes are %s; expected %s\n", mine.c_str(), golden.c_str()),
           1;
}

} // namespace

int main(int argc, char** argv) {
    constexpr int kSkipped = 77;
    if (argc < 2)
        return std::fprintf(stderr,
                            "usage: live_hash GOLDEN_FILE [instruction set|best] [threads]\n"
                            "       live_hash --print\n"),
               2;
    try {
        if (std::string(argv[1]) == "--print")
            return std::puts(simulate({}).c_str()), 0;
        RunOptions options;
        if (argc > 2 && std::string(argv[2]) != "best")
            options.instruction_set = argv[2];
        options.threads = argc > 3 ? static_cast<unsigned>(std::atoi(argv[3])) : 1;
        return compare(argv[1], options);
    } catch (const InputError& error) {
        const std::string message = error.what();
        if (message.starts_with("instruction set")) // this machine has it not
            return std::printf("skipped: %s\n", error.what()), kSkipped;
        return std::fprintf(stderr, "%s\n", error.what()), 1;
    }
}
