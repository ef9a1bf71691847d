#pragma once

#include <cstddef>

namespace mane {

/// Makes a vector `n` long, whatever is in it then. Where there is no room, the old is given back
/// first, and the new has an eighth to spare: resize() would hold both at once, and twice what is
/// asked for.
template <typename Vector> void make_room(Vector& vector, std::size_t n) {
    if (vector.capacity() < n) {
        vector = Vector();
        vector.reserve(n + n / 8);
    }
    vector.resize(n);
}

} // namespace mane
