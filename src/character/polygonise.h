#pragma once

#include "character/bust_shape.h"
#include "mane/body.h"

namespace mane {

// The zero level of `distance` inside `box` as triangles, counter-clockwise seen from outside, by
// marching tetrahedra with six to a cube of side `cell` [m]. Always closed and manifold if the
// level does not reach the box (marching cubes and nets are not, where a cell is ambiguous). The
// triangles are uneven: made to be remeshed.
Mesh polygonise(double (*distance)(const Vec3d&), const Box& box, double cell);

} // namespace mane
