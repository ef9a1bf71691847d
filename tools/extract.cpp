#include "commands.h"

#include "mane/error.h"
#include "mane/export.h"
#include "mane/strands.h"
#include "replay.h"

namespace mane::tool {

int extract(const ExtractOptions& options) {
    const Replay replay(options.file);
    const Frame frame = replay.frame(options.frame);
    if (options.layer == "strands") {
        const SceneDesc& scene = replay.scene();
        StrandDesc strands = scene.hair.strands;
        strands.count = options.strands.value_or(strands.count);
        write_curves(make_strands(replay.groom(), frame, strands, scene.simulation.seed,
                                  options.samples, options.threads),
                     frame.origin, options.output);
    } else if (options.layer == "skeleton") {
        write_curves(skeleton_curves(replay.groom(), frame), frame.origin, options.output);
    } else if (options.layer == "envelope") {
        write_mesh(envelope_mesh(replay.groom(), frame), frame.origin, options.output);
    } else if (options.layer == "character") {
        write_mesh(
            {replay.cache().body_vertices(options.frame, 0), replay.bodies().at(0).mesh.triangles},
            frame.origin, options.output);
    } else {
        throw InputError("unknown layer '" + options.layer +
                         "', expected strands, skeleton, envelope or character");
    }
    return 0;
}

} // namespace mane::tool
