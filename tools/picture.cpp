#include "commands.h"

#include "mane/cache.h"
#include "mane/picture.h"
#include "stored_frame.h"

#include <algorithm>

namespace mane::tool {
namespace {

/// The index of `name` in `names`, which the command line has checked.
template <typename Enum>
Enum named(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<Enum>(std::ranges::find(names, name) - names.begin());
}

PictureDesc describe(const PictureOptions& options) {
    PictureDesc desc;
    desc.width = options.size[0];
    desc.height = options.size.back();
    desc.samples = options.samples;
    desc.layer = named<PictureLayer>(layer_names(), options.layer);
    desc.strands = options.strands;
    desc.colour_by_wisp = options.colour_by_wisp;
    desc.frame_height = options.height;
    desc.threads = options.threads;
    if (!options.eye.empty()) {
        const auto point = [](const std::vector<double>& p) { return Vec3d(p[0], p[1], p[2]); };
        desc.camera =
            Camera{point(options.eye), point(options.target), {0, 1, 0}, options.field_of_view};
    }
    return desc;
}

Image draw(const CacheReader& cache, const SceneDesc& scene, const StoredFrame& stored,
           const PictureDesc& desc) {
    std::vector<PictureBody> bodies;
    for (const Mesh& body : stored.bodies)
        bodies.push_back({body.vertices, body.triangles});
    return render(cache.setup().groom, stored.frame, scene.hair.strands, scene.simulation.seed,
                  bodies, {stored.head_centre, stored.head_rotation}, desc);
}

} // namespace

int picture(const PictureOptions& options) {
    const CacheReader cache(options.file);
    const SceneDesc scene = scene_of(cache, options.file);
    PictureDesc desc = describe(options);
    std::vector<StoredFrame>
        frames; // all are read before the first is drawn: a wrong number is said at once
    for (const std::size_t frame : options.frames)
        frames.push_back(load_frame(cache, frame));
    std::vector<Image> images;
    std::vector<std::string> labels;
    for (const StoredFrame& stored : frames)
        for (const std::string& view : options.views) {
            desc.view = named<View>(view_names(), view);
            images.push_back(draw(cache, scene, stored, desc));
            labels.push_back("frame " + std::to_string(stored.frame.index) + " " + view);
        }
    const std::size_t columns =
        options.views.size() > 1 ? options.views.size() : std::min<std::size_t>(images.size(), 6);
    write_png(images.size() == 1
                  ? images[0]
                  : contact_sheet(images, labels, static_cast<std::uint32_t>(columns)),
              options.output);
    return 0;
}

} // namespace mane::tool
