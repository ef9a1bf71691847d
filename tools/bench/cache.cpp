#include "mane/cache.h"
#include "bench/measure.h"
#include "bench/scratch_file.h"
#include "mane/scene.h"
#include "mane/setup.h"
#include "mane/world.h"
#include "poses.h"

namespace mane::bench {
namespace {

constexpr std::uint32_t kSimulated = 4, kStored = 96; // frames: the former over and over

std::vector<Frame> some_frames(const SceneDesc& scene, const RunSetup& setup) {
    World world(scene.simulation, setup.groom, setup.bodies);
    std::vector<Frame> frames{world.frame()};
    while (frames.size() < kSimulated) {
        world.advance();
        frames.push_back(world.frame());
    }
    return frames;
}

double megabytes(const std::vector<ChunkInfo>& chunks, std::uint64_t ChunkInfo::*size) {
    double sum = 0;
    for (const ChunkInfo& chunk : chunks)
        if (chunk.type == "FRAM")
            sum += 1e-6 * static_cast<double>(chunk.*size);
    return sum;
}

} // namespace

Json measure_cache(const Case& c) {
    const SceneDesc scene = read_scene(c.scene);
    const RunSetup setup = prepare(scene);
    std::vector<Frame> frames = some_frames(scene, setup);

    const ScratchFile file;
    Watch writing, reading;
    CacheWriter writer(file.path(), setup);
    for (std::uint32_t i = 0; i < kStored; ++i) {
        Frame& frame = frames[i % kSimulated];
        frame.index = i;
        const BodyPoses poses = tool::poses_at(setup.bodies, frame.time);
        writing.go();
        writer.add(frame, poses);
        writing.hold();
    }
    writer.finish();

    const CacheReader reader(file.path());
    reading.go();
    for (std::size_t i = 0; i < reader.frame_count(); ++i)
        static_cast<void>(reader.frame(i));
    reading.hold();

    const double raw = megabytes(reader.chunks(), &ChunkInfo::raw);
    return {{"scene", c.scene},
            {"frames", kStored},
            {"mb_per_frame", raw / kStored},
            {"write_mb_per_second", raw / writing.wall()},
            {"read_mb_per_second", raw / reading.wall()},
            {"packed_share", megabytes(reader.chunks(), &ChunkInfo::stored) / raw},
            {"peak_mb", peak_megabytes()}};
}

} // namespace mane::bench
