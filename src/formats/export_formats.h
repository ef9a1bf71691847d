#pragma once

#include "base/whole_file.h"
#include "mane/body.h"
#include "mane/curves.h"

namespace mane {

// One format each; `write_curves` and `write_mesh` choose by the file name's ending.
void write_hair(const Curves& curves, const Vec3d& origin, WholeFile& file);
void write_ply(const Curves& curves, const Vec3d& origin, WholeFile& file);
void write_ply(const Mesh& mesh, const Vec3d& origin, WholeFile& file);
void write_obj(const Curves& curves, const Vec3d& origin, WholeFile& file);
void write_obj(const Mesh& mesh, const Vec3d& origin, WholeFile& file);

} // namespace mane
