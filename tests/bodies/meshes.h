#pragma once

#include "mane/body.h"

#include <string>

/// Meshes for tests, all counter-clockwise from outside.
namespace mane::test {

/// A sphere of 20·4^`levels` triangles.
Mesh icosphere(int levels, float radius, const Vec3& centre = {});
/// A torus round the y axis, `major` × `minor` quads.
Mesh torus(int major, int minor, float ring_radius, float tube_radius);
/// The box from `low` to `high`, each side `n` × `n` quads.
Mesh box(const Vec3& low, const Vec3& high, int n = 1);
/// Both meshes as one, not joined.
Mesh together(const Mesh& a, const Mesh& b);
/// Only the triangles whose mean is above y = `height`: an open border.
Mesh cut_below(const Mesh& mesh, float height);
/// The vertices moved.
Mesh moved(const Mesh& mesh, const Vec3& by);

/// Positions and faces of an OBJ file of the shared data, centred, scaled to a height of `size`
/// [m]; `found` false where it is missing.
Mesh data_mesh(const std::string& path, float size, bool& found);

} // namespace mane::test
