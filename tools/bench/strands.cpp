#include "mane/strands.h"
#include "bench/measure.h"
#include "mane/scene.h"
#include "mane/setup.h"
#include "mane/world.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <thread>
#include <utility>

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

/// The strands' vertices, as a renderer's buffers, filled by one thread or by several.
class Buffers {
  public:
    explicit Buffers(const StrandShape& shape)
        : shape_(shape), positions_(shape.vertex_count()), widths_(shape.vertex_count()) {}

    double seconds(unsigned threads) {
        return best_seconds([&] { side_by_side(threads, &Buffers::fill); });
    }
    /// What no one who fills them can be faster than.
    double plain_seconds(unsigned threads) {
        return best_seconds([&] { side_by_side(threads, &Buffers::fill_plainly); });
    }

  private:
    void side_by_side(unsigned threads, void (Buffers::*part)(std::size_t, std::size_t)) {
        const std::size_t strands = shape_.strand_count();
        std::vector<std::jthread> workers;
        for (unsigned t = 1; t < threads; ++t)
            workers.emplace_back(
                [=, this] { (this->*part)(t * strands / threads, (t + 1) * strands / threads); });
        (this->*part)(0, strands / threads);
    }
    void fill(std::size_t first, std::size_t last) {
        const auto [from, size] = range(first, last);
        shape_.fill(first, last - first, std::span(positions_).subspan(from, size),
                    std::span(widths_).subspan(from, size));
    }
    void fill_plainly(std::size_t first, std::size_t last) {
        const auto [from, size] = range(first, last);
        std::ranges::fill(std::span(positions_).subspan(from, size), Vec3(1, 2, 3));
        std::ranges::fill(std::span(widths_).subspan(from, size), 1.f);
    }
    std::pair<std::size_t, std::size_t> range(std::size_t first, std::size_t last) const {
        const std::size_t from = shape_.first_vertex(first);
        return {from, shape_.first_vertex(last) - from};
    }

    const StrandShape& shape_;
    std::vector<Vec3> positions_;
    std::vector<float> widths_;
};

} // namespace

Json measure_strands(const Case& c) {
    SceneDesc scene = read_scene(c.scene);
    StrandDesc& desc = scene.hair.strands;
    desc.count = kStrands;
    if (c.kind == Kind::moving_strands) {
        desc.waves = 6;
        desc.wave_amplitude = 0.2f;
        desc.curls = 3;
    }
    const RunSetup setup = prepare(scene);
    const World world(scene.simulation, setup.groom, setup.bodies);
    Watch making;
    making.go();
    StrandShape shape(setup.groom, desc, scene.simulation.seed, kSamples);
    making.hold();
    const double posing = best_seconds([&] { shape.pose(world.frame()); });
    Buffers buffers(shape);
    const double plain = buffers.plain_seconds(c.threads), drawn = buffers.seconds(c.threads);
    const auto vertices = static_cast<double>(shape.vertex_count());
    return {{"scene", c.scene},
            {"threads", c.threads},
            {"strands", shape.strand_count()},
            {"vertices", shape.vertex_count()},
            {"ns_per_vertex", 1e9 * drawn / vertices},
            {"million_strands_of_32_per_second", 1e-6 * vertices / kVertices / drawn},
            {"plain_fill_gb_per_second", 1e-9 * vertices * (sizeof(Vec3) + sizeof(float)) / plain},
            {"share_of_plain_fill", plain / drawn},
            {"recipes_ms", 1000 * making.wall()},
            {"pose_ms", 1000 * posing},
            {"peak_mb", peak_megabytes()}};
}

} // namespace mane::bench
