#include "commands.h"

#include "mane/cache.h"
#include "mane/error.h"
#include "mane/export.h"
#include "mane/strands.h"
#include "stored_frame.h"

namespace mane::tool {
namespace {

/// All bodies as one mesh.
Mesh joined(const std::vector<Mesh>& bodies) {
    Mesh all;
    for (const Mesh& body : bodies) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        all.vertices.insert(all.vertices.end(), body.vertices.begin(), body.vertices.end());
        for (const auto& [a, b, c] : body.triangles)
            all.triangles.push_back({first + a, first + b, first + c});
    }
    return all;
}

} // namespace

int extract(const ExtractOptions& options) {
    const CacheReader cache(options.file);
    const StoredFrame stored = load_frame(cache, options.frame);
    const Groom& groom = cache.setup().groom;
    const Frame& frame = stored.frame;
    if (options.layer == "strands") {
        const SceneDesc scene = scene_of(cache, options.file);
        StrandDesc strands = scene.hair.strands;
        strands.count = options.strands.value_or(strands.count);
        write_curves(make_strands(groom, frame, strands, scene.simulation.seed, options.samples,
                                  options.threads),
                     frame.origin, options.output);
    } else if (options.layer == "skeleton") {
        write_curves(skeleton_curves(groom, frame, options.samples), frame.origin, options.output);
    } else if (options.layer == "envelope") {
        write_mesh(envelope_mesh(groom, frame, options.samples), frame.origin, options.output);
    } else {
        write_mesh(joined(stored.bodies), frame.origin, options.output);
    }
    return 0;
}

} // namespace mane::tool
