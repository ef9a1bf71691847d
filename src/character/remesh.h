#pragma once

#include "mane/body.h"

namespace mane {

// A smooth surface and how finely it is to be divided.
struct RemeshTarget {
    double (*distance)(const Vec3d&);    // signed distance to the surface; its zero level is kept
    double (*edge_length)(const Vec3d&); // [m] wanted there
};

// Makes the triangles of a closed manifold mesh near the surface even: splits long edges, collapses
// short ones, flips edges that make narrow triangles, and moves vertices along the surface, a few
// rounds (Botsch & Kobbelt 2004). Stays closed, manifold and of the same genus.
Mesh remesh(const Mesh& mesh, const RemeshTarget& target, int rounds);

} // namespace mane
