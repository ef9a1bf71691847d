#include "mane/export.h"

#include "formats/export_formats.h"
#include "mane/error.h"

namespace mane {
namespace {

template <typename Layer> using Writer = void (*)(const Layer&, const Vec3d&, WholeFile&);

template <typename Layer> void write_with(Writer<Layer> writer, const Layer& layer,
                                          const Vec3d& origin, const std::filesystem::path& path) {
    WholeFile file(path);
    writer(layer, origin, file);
    file.finish();
}

[[noreturn]] void unknown_ending(const std::filesystem::path& path, const char* what,
                                 const char* expected) {
    throw InputError("cannot write " + path.string() + ": '" + path.extension().string() +
                     "' is no format for " + what + ", expected " + expected);
}

} // namespace

void write_curves(const Curves& curves, const Vec3d& origin, const std::filesystem::path& path) {
    const std::filesystem::path ending = path.extension();
    if (ending == ".hair")
        return write_with<Curves>(write_hair, curves, origin, path);
    if (ending == ".ply")
        return write_with<Curves>(write_ply, curves, origin, path);
    if (ending == ".obj")
        return write_with<Curves>(write_obj, curves, origin, path);
    unknown_ending(path, "curves", ".hair, .ply or .obj");
}

void write_mesh(const Mesh& mesh, const Vec3d& origin, const std::filesystem::path& path) {
    const std::filesystem::path ending = path.extension();
    if (ending == ".ply")
        return write_with<Mesh>(write_ply, mesh, origin, path);
    if (ending == ".obj")
        return write_with<Mesh>(write_obj, mesh, origin, path);
    unknown_ending(path, "meshes", ".ply or .obj");
}

} // namespace mane
