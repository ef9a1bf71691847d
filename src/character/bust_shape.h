#pragma once

#include "mane/vec.h"

namespace mane {

// The bust as a signed distance [m], negative inside; near the surface, its gradient is close to
// one. Symmetric in x.
double bust_distance(const Vec3d& p);

// The ears alone, to tell them from the scalp.
double ear_distance(const Vec3d& p);

// The box around it.
struct Box {
    Vec3d low, high;
};
Box bust_box();

} // namespace mane
