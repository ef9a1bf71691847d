#include "commands.h"

#include "mane/error.h"
#include "mane/picture.h"
#include "replay.h"

#include <fmt/core.h>

#include <map>

namespace mane::tool {
namespace {

template <typename T>
T named(const std::map<std::string, T>& names, const std::string& what, const std::string& name) {
    if (const auto found = names.find(name); found != names.end())
        return found->second;
    std::string expected;
    for (const auto& [known, value] : names)
        expected += (expected.empty() ? "" : ", ") + known;
    throw InputError(fmt::format("unknown {} '{}', expected one of {}", what, name, expected));
}

PictureLayer layer_named(const std::string& name) {
    return named<PictureLayer>({{"strands", PictureLayer::strands},
                                {"skeleton", PictureLayer::skeleton},
                                {"envelope", PictureLayer::envelope},
                                {"character", PictureLayer::character}},
                               "layer", name);
}

View view_named(const std::string& name) {
    return named<View>({{"face", View::face},
                        {"three-quarter", View::three_quarter},
                        {"profile", View::profile},
                        {"back", View::back}},
                       "view", name);
}

// Between the roots of the hair, which ride the head: right for any character and any rig.
HeadPose head_pose(const Replay& replay, std::uint32_t frame) {
    const Groom& groom = replay.groom();
    Vec3d rest;
    for (std::size_t w = 0; w < groom.wisp_count(); ++w)
        rest +=
            Vec3d(groom.position[groom.first_section[w]]) / static_cast<double>(groom.wisp_count());
    const std::uint32_t bone = replay.bodies().at(0).head_bone;
    const std::vector<BonePose> bones = replay.cache().poses(frame).at(0);
    if (bone >= bones.size())
        return {rest, {}};
    return {bones[bone].rotation.rotate(rest) + bones[bone].position, bones[bone].rotation};
}

Image picture_of(const Replay& replay, std::uint32_t number, const PictureDesc& desc) {
    const Frame frame = replay.frame(number);
    std::vector<std::vector<Vec3>> vertices;
    for (std::size_t b = 0; b < replay.bodies().size(); ++b)
        vertices.push_back(replay.cache().body_vertices(number, b));
    std::vector<PictureBody> bodies;
    for (std::size_t b = 0; b < vertices.size(); ++b)
        bodies.push_back({vertices[b], replay.bodies()[b].mesh.triangles});
    const SceneDesc& scene = replay.scene();
    return render(replay.groom(), frame, scene.hair.strands, scene.simulation.seed, bodies,
                  head_pose(replay, number), desc);
}

PictureDesc description(const PictureOptions& options) {
    PictureDesc desc;
    desc.width = desc.height = options.size;
    desc.samples = options.samples;
    desc.strands = options.strands;
    desc.layer = layer_named(options.layer);
    desc.colour_by_wisp = options.colour_by_wisp;
    desc.frame_height = options.height;
    desc.threads = options.threads;
    if (!options.eye.empty()) {
        const std::vector<double>&e = options.eye, &t = options.target;
        desc.camera = Camera{{e[0], e[1], e[2]}, {t[0], t[1], t[2]}};
    }
    return desc;
}

} // namespace

int picture(const PictureOptions& options) {
    const Replay replay(options.file);
    PictureDesc desc = description(options);
    std::vector<Image> images;
    std::vector<std::string> labels;
    for (const std::string& view : options.views)
        for (const std::uint32_t frame : options.frames) {
            desc.view = view_named(view);
            images.push_back(picture_of(replay, frame, desc));
            labels.push_back(fmt::format("{} {}", view, frame));
        }
    const auto columns = static_cast<std::uint32_t>(options.frames.size());
    write_png(images.size() == 1 ? images[0] : contact_sheet(images, labels, columns),
              options.output);
    return 0;
}

} // namespace mane::tool
