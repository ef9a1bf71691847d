#include "host/handle.h"

#include "mane/setup.h"

#include <memory>

namespace mane {
namespace {

std::unique_ptr<mane_world> create(const SceneDesc& scene, const mane_options& options) {
    std::shared_ptr<DrivenBust> bust;
    if (!options.scene_motion)
        bust = std::make_shared<DrivenBust>();
    const RunSetup setup = bust ? prepare(scene, bust) : prepare(scene);
    const RunOptions run = run_options(options);
    return std::make_unique<mane_world>(make_live(scene, setup, options.start_time, run), bust,
                                        std::vector<std::shared_ptr<DrivenMotion>>{}, run);
}

} // namespace
} // namespace mane

using namespace mane;

mane_result mane_create_from_scene_file(const char* path, const mane_options* options,
                                        mane_world** world) {
    return guarded([&] {
        given(world, "world");
        *world = create(read_scene(&given(path, "path")), known_options(options)).release();
    });
}

mane_result mane_create_from_scene_text(const char* text, const char* folder,
                                        const mane_options* options, mane_world** world) {
    return guarded([&] {
        given(world, "world");
        const SceneDesc scene = parse_scene(&given(text, "text"), "scene", folder ? folder : ".");
        *world = create(scene, known_options(options)).release();
    });
}
