// Prints the state hash of a run in which everything happens, and compares it with the golden one:
// a program of its own and not a test case, so that node can run it too (M39).
//   state_hash GOLDEN_FILE FRAMES [instruction set|best] [threads]
//   state_hash --print FRAMES...     the golden file's lines for these numbers of frames

#include "mane/character.h"
#include "mane/style.h"
#include "mane/world.h"

#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

namespace {

using namespace mane;

/// scenes/medium.toml: 73 wisps of 9.9 segments. The core alone reads no files.
HairDesc medium() {
    HairDesc hair;
    StyleDesc& style = hair.style;
    style.wisps = 73, style.segments = 9.9f;
    style.nape_length = 0.26f, style.crown_length = 0.34f;
    style.root_radius = 0.026f, style.radius = 0.03f, style.tip_radius = 0.015f;
    style.widest = 0.5f;
    hair.skeleton.strain = 0.0055f;
    return hair;
}

Mesh box(const Vec3& size) {
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner)
        mesh.vertices.push_back({corner & 1 ? size.x / 2 : -size.x / 2,
                                 corner & 2 ? size.y / 2 : -size.y / 2,
                                 corner & 4 ? size.z / 2 : -size.z / 2});
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// Sweeps to and fro behind the neck, through the hair, turning as it goes. The first sweep is
/// over within a second, so that short runs have it.
Body obstacle() {
    Body body;
    body.name = "obstacle";
    body.mesh = box({0.06f, 0.16f, 0.06f});
    std::vector<MotionKey> keys;
    const double times[] = {0, 0.9, 2.5, 4, 5.5, 7.2, 9, 10.5};
    for (int i = 0; i < 8; ++i) {
        const double side = i % 2 == 0 ? 1 : -1;
        keys.push_back({times[i], {0.3 * side, 1.36 + 0.01 * i, -0.15}, {0, 0.3 * side, 0.1, 1}});
    }
    body.motion = keyframed_motion(keys);
    return body;
}

struct Scene {
    SimulationDesc desc;
    Groom groom;
    std::vector<Body> bodies;
};

Scene make_scene() {
    Scene scene;
    scene.desc.air.wind = {1, 0, 0.5f};
    scene.desc.air.gusts = 1;
    scene.desc.wisps.axis_contact_ratio = 0.5f; // the style's segments are short: some qualify
    Body bust = make_bust();
    bust.motion = builtin_motion();
    const std::vector<std::uint32_t> scalp = bust_scalp(bust);
    scene.groom = make_groom(lay_style(medium(), bust, scalp), bust.mesh);
    scene.bodies = {bust, obstacle()};
    return scene;
}

struct Result {
    std::uint64_t hash = 0;
    const char* instruction_set = "";
    Statistics statistics;
};

Result simulate(const Scene& scene, int frames, const RunOptions& options) {
    World world(scene.desc, scene.groom, scene.bodies, 0, options);
    for (int i = 0; i < frames; ++i)
        world.advance();
    return {world.state_hash(), world.instruction_set(), world.statistics()};
}

/// Contacts from axis to axis have no count of their own. They are all that the ratio decides on,
/// so where they occur, the same scene without them goes another way; it is followed that far.
bool has_axis_contacts(const Scene& scene, int frames, const RunOptions& options) {
    SimulationDesc without = scene.desc;
    without.wisps.axis_contact_ratio = std::numeric_limits<float>::max();
    World a(scene.desc, scene.groom, scene.bodies, 0, options),
        b(without, scene.groom, scene.bodies, 0, options);
    for (int i = 0; i < frames && a.state_hash() == b.state_hash(); ++i) {
        a.advance();
        b.advance();
    }
    return a.state_hash() != b.state_hash();
}

/// Whether every kind of contact occurs; says which does not.
bool has_all_contacts(const Statistics& s, bool axis) {
    std::printf("%" PRIu64 " friction, %" PRIu64 " collision and %" PRIu64
                " sliding contacts, %" PRIu64 " penetration reactions\n",
                s.friction_contacts, s.collision_contacts, s.sliding_contacts,
                s.penetration_reactions);
    const struct {
        const char* kind;
        bool occurs;
    } kinds[] = {{"friction contacts", s.friction_contacts > 0},
                 {"collision contacts", s.collision_contacts > 0},
                 {"axis contacts", axis},
                 {"sliding contacts", s.sliding_contacts > 0},
                 {"penetration reactions", s.penetration_reactions > 0}};
    bool all = true;
    for (const auto& [kind, occurs] : kinds)
        if (!occurs)
            std::fprintf(stderr, "the scene has no %s\n", kind), all = false;
    return all;
}

std::string hex(std::uint64_t hash) {
    char text[17];
    std::snprintf(text, sizeof text, "%016" PRIx64, hash);
    return text;
}

/// The golden hash of a run of this many frames; empty if the file has none.
std::string golden_hash(const std::string& file, int frames) {
    std::ifstream in(file);
    int count = 0;
    for (std::string hash; in >> count >> hash;)
        if (count == frames)
            return hash;
    return {};
}

int compare(const std::string& golden_file, int frames, const RunOptions& options) {
    const Scene scene = make_scene();
    const Result mine = simulate(scene, frames, options);
    std::printf("%s, %u threads: %s after %d frames\n", mine.instruction_set, options.threads,
                hex(mine.hash).c_str(), frames);
    const bool all = has_all_contacts(mine.statistics, has_axis_contacts(scene, frames, options));
    const std::string golden = golden_hash(golden_file, frames);
    if (golden != hex(mine.hash))
        std::fprintf(stderr, "the state hash is %s; expected %s\n", hex(mine.hash).c_str(),
                     golden.empty() ? "a line for this number of frames" : golden.c_str());
    else if (all)
        return std::puts("script test passed"), 0;
    return 1;
}

int print(int count, char** frames) {
    const Scene scene = make_scene();
    for (int i = 0; i < count; ++i)
        std::printf("%d %s\n", std::atoi(frames[i]),
                    hex(simulate(scene, std::atoi(frames[i]), {}).hash).c_str());
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    constexpr int kSkipped = 77;
    if (argc < 3)
        return std::fprintf(
                   stderr, "usage: state_hash GOLDEN_FILE FRAMES [instruction set|best] [threads]\n"
                           "       state_hash --print FRAMES...\n"),
               2;
    if (std::string(argv[1]) == "--print")
        return print(argc - 2, argv + 2);
    RunOptions options;
    if (argc > 3 && std::string(argv[3]) != "best")
        options.instruction_set = argv[3];
    options.threads = argc > 4 ? static_cast<unsigned>(std::atoi(argv[4])) : 1;
    try {
        return compare(argv[1], std::atoi(argv[2]), options);
    } catch (const InputError& error) {
        const std::string message = error.what();
        if (message.starts_with("instruction set")) // this machine has it not
            return std::printf("skipped: %s\n", error.what()), kSkipped;
        return std::fprintf(stderr, "%s\n", error.what()), 1;
    }
}
