#include "mane/strands.h"
#include "bench/measure.h"
#include "mane/scene.h"
#include "mane/setup.h"
#include "mane/world.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <thread>

namespace mane::bench {
namespace {

constexpr std::uint32_t kStrands = 100000;
constexpr double kVertices = 32;      // of a strand, what the figures are for
constexpr std::uint32_t kSamples = 4; // per segment: some 36 vertices in `long`
constexpr int kTimes = 5;             // the best of them: the buffer is in no cache all the same

double best_seconds(const std::function<void()>& work) {
    double best = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kTimes; ++i) {
        Watch watch;
        watch.go();
        work();
        watch.hold();
        best = std::min(best, watch.wall());
    }
    return best;
}

/// The strands' vertices, as a renderer's buffers.
struct Buffers {
    std::vector<Vec3> positions;
    std::vector<float> widths;

    explicit Buffers(std::size_t vertices) : positions(vertices), widths(vertices) {}

    void fill(const StrandShape& shape, std::size_t first, std::size_t last) {
        const std::size_t from = shape.first_vertex(first), to = shape.first_vertex(last);
        shape.fill(first, last - first, std::span(positions).subspan(from, to - from),
                   std::span(widths).subspan(from, to - from));
    }
    void fill_side_by_side(const StrandShape& shape, unsigned threads) {
        std::vector<std::jthread> workers;
        for (unsigned t = 0; t < threads; ++t)
            workers.emplace_back([&, t] {
                fill(shape, t * shape.strand_count() / threads,
                     (t + 1) * shape.strand_count() / threads);
            });
    }
    /// What no one who fills them can be faster than.
    void fill_plainly() {
        std::ranges::fill(positions, Vec3(1, 2, 3));
        std::ranges::fill(widths, 1.f);
    }
};

} // namespace

Json measure_strands(const Case& c) {
    SceneDesc scene = read_scene(c.scene);
    scene.hair.strands.count = kStrands;
    const RunSetup setup = prepare(scene);
    const World world(scene.simulation, setup.groom, setup.bodies);
    const StrandShape shape(setup.groom, world.frame(), scene.hair.strands, scene.simulation.seed,
                            kSamples);
    Buffers buffers(shape.vertex_count());
    const double plain = best_seconds([&] { buffers.fill_plainly(); });
    const double one = best_seconds([&] { buffers.fill(shape, 0, shape.strand_count()); });
    const double all = best_seconds([&] { buffers.fill_side_by_side(shape, c.threads); });
    const double vertices = static_cast<double>(shape.vertex_count());
    return {{"scene", c.scene},
            {"threads", c.threads},
            {"strands", shape.strand_count()},
            {"vertices", shape.vertex_count()},
            {"ns_per_vertex", 1e9 * one / vertices},
            {"million_strands_of_32_per_second", 1e-6 * vertices / kVertices / one},
            {"million_strands_of_32_per_second_all_threads", 1e-6 * vertices / kVertices / all},
            {"plain_fill_gb_per_second", 1e-9 * vertices * (sizeof(Vec3) + sizeof(float)) / plain},
            {"times_plain_fill", one / plain},
            {"peak_mb", peak_megabytes()}};
}

} // namespace mane::bench
