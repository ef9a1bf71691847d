#pragma once

#include "mane/body.h"
#include "mane/curves.h"
#include "mane/vec.h"

#include <filesystem>

namespace mane {

/// Layers of a frame as files for other programs, in metres in the world, Y up. `origin` is the
/// frame's. Files are written beside their place and renamed when whole. All throw InputError with
/// the path and the system's reason, or for a file name whose ending is none of those named.

/// `.hair`: Cem Yuksel's HAIR files, with segments and thickness (diameters). `.ply`: binary
/// vertices with `width`, joined by edges. `.obj`: one line element per curve, no widths.
void write_curves(const Curves& curves, const Vec3d& origin, const std::filesystem::path& path);

/// `.ply`: binary vertices and triangles. `.obj`: the same as text.
void write_mesh(const Mesh& mesh, const Vec3d& origin, const std::filesystem::path& path);

} // namespace mane
