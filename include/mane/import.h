#pragma once

#include "mane/body.h"
#include "mane/clip.h"

#include <cstddef>
#include <string>

namespace mane {

/// What a mesh has that a closed surface has not. Real heads have some of each: a warning, never an
/// error.
struct MeshReport {
    std::size_t open_edges = 0; ///< edges of one triangle: the surface has a border there
    std::size_t non_manifold_edges =
        0; ///< edges of more than two triangles, or of two that disagree on the outside
    std::size_t flat_triangles = 0;    ///< triangles without area; kept, as they may join others
    std::size_t dropped_triangles = 0; ///< triangles that name a vertex twice; left out

    bool clean() const {
        return open_edges + non_manifold_edges + flat_triangles + dropped_triangles == 0;
    }
    /// One line for a log, such as "945 open edges, 29 non-manifold edges"; empty when clean.
    std::string warning() const;
};

/// The report of any mesh.
MeshReport inspect_mesh(const Mesh& mesh);

/// Reads the polygons of a Wavefront OBJ file (`v` and `f`; all other statements are skipped) as
/// one mesh. Polygons become fans of triangles. All vertices stay, so that indices are the file's,
/// but of several at the same position (seams of textures) the triangles use the first. Coordinates
/// are multiplied by `unit` [m]. Throws InputError with the line for a missing or truncated file,
/// an index that names no vertex, a coordinate that is not a finite number, and for a mesh without
/// area.
Mesh read_obj(const std::string& path, double unit = 1, MeshReport* report = nullptr);

/// Reads a BVH file: any hierarchy, several roots, channels in any order, End Sites. Throws
/// InputError with the line for a missing or truncated file, a channel that is not a finite number,
/// and for counts that do not fit.
Clip read_bvh(const std::string& path);

} // namespace mane
