#include "synthetic_run.h"

#include "bodies/meshes.h"
#include "mane/setup.h"
#include "mane/style.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

namespace mane::test {
namespace {

constexpr double kLag = 0.02; // [s] from section to section

/// How far the head is to the side, and how fast.
struct Side {
    double x = 0, speed = 0;
};
Side head_side(double time) {
    if (time <= 0 || time >= kStop)
        return {};
    const double turn = 2 * std::numbers::pi;
    return {0.05 * (1 - std::cos(turn * time)), 0.05 * turn * std::sin(turn * time)};
}

std::uint32_t triangle_toward(const Mesh& mesh, const Vec3& direction) {
    std::uint32_t best = 0;
    float largest = -1;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        Vec3 sum;
        for (const std::uint32_t v : mesh.triangles[t])
            sum += mesh.vertices[v] - kHead;
        if (dot(sum, direction) > largest)
            largest = dot(sum, direction), best = t;
    }
    return best;
}

RunSetup make_setup(std::vector<WispDesign>& designs) {
    Body head;
    head.name = "head";
    head.mesh = icosphere(3, kHeadRadius, kHead);
    for (const Vec3& side : {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 0, 1}}) {
        StraightWisp wisp;
        wisp.triangle = triangle_toward(head.mesh, side);
        wisp.length = 0.3f;
        wisp.segments = kTip - 1;
        wisp.radius = {0.008f, 0.006f};
        designs.push_back(design(wisp, head.mesh));
    }
    RunSetup setup;
    setup.groom = make_groom(designs, head.mesh);
    setup.bodies = {head};
    return setup;
}

Frame make_frame(const RunSetup& setup, const std::vector<WispDesign>& designs,
                 std::uint32_t index) {
    Frame f;
    f.index = index;
    f.time = index / kFrameRate;
    f.origin = Vec3d(kHead) + Vec3d{head_side(f.time).x, 0, 0};
    f.radius = setup.groom.radius;
    f.radius_rate.assign(f.radius.size(), 0);
    for (const WispDesign& wisp : designs) {
        f.first_axis.push_back(wisp.first_axis);
        for (std::size_t i = 0; i < wisp.position.size(); ++i) {
            const Side side = head_side(f.time - (i < 2 ? 0 : kLag * double(i - 1)));
            f.position.push_back(Vec3(Vec3d(wisp.position[i]) + Vec3d{side.x, 0, 0} - f.origin));
            f.velocity.push_back({float(side.speed), 0, 0});
        }
    }
    return f;
}

/// A file that goes with the test.
struct TemporaryFile {
    std::filesystem::path path = std::filesystem::temp_directory_path() /
                                 ("mane_check_" + std::to_string(std::random_device{}()) + ".mane");
    ~TemporaryFile() { std::filesystem::remove(path); }
};

} // namespace

void SyntheticRun::add_obstacle(const Mesh& mesh, bool worn) {
    Body body;
    body.name = "obstacle";
    body.mesh = mesh;
    body.worn = worn;
    setup.bodies.push_back(body);
    for (BodyPoses& p : poses)
        p.emplace_back();
}

template <typename Look> auto SyntheticRun::look_at(const Look& look) const {
    const TemporaryFile file;
    RunSetup written = setup;
    written.scene = write_scene(scene);
    CacheWriter writer(file.path, written);
    for (std::size_t i = 0; i < frames.size(); ++i)
        writer.add(frames[i], poses[i]);
    writer.finish(statistics);
    return look(CacheReader(file.path));
}

CheckReport SyntheticRun::judge() const {
    return look_at([](const CacheReader& run) { return check_run(run, {.strands = 60}); });
}

std::vector<FrameFigures> SyntheticRun::figures() const {
    return look_at([](const CacheReader& run) { return frame_figures(run); });
}

SyntheticRun good_run() {
    SyntheticRun run;
    std::vector<WispDesign> designs;
    run.setup = make_setup(designs);
    for (std::uint32_t i = 0; i < run.scene.simulation.schedule.frames; ++i) {
        run.frames.push_back(make_frame(run.setup, designs, i));
        const Side head = head_side(run.frames.back().time);
        run.poses.push_back({{{{head.x, 0, 0}, {}, {head.speed, 0, 0}, {}}}});
    }
    return run;
}

} // namespace mane::test
