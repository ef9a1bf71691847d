#pragma once

#include "base/aligned.h"
#include "character/surface_search.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mane {

/// What keep_local works on: of places side by side, the squared distances and the corners of their
/// triangles. Scratch, kept from call to call.
struct PlaceRows {
    AlignedVector<double> squared;
    std::array<AlignedVector<std::uint32_t>, 3> corner;

    void resize(std::size_t n) {
        squared.resize(n);
        for (auto& corners : corner)
            corners.resize(n);
    }
};

/// Of the nearest places of all of some triangles within a radius (in any order, which stays),
/// leaves those that are nearest among all that share their face, edge or corner: of a convex
/// stretch the one nearest place, of a hollow one for each wall. A place is compared with sixteen
/// at a time; the answer is the same for every instruction set.
using KeepLocal = void(std::span<const std::array<std::uint32_t, 3>> triangles, PlaceRows& rows,
                       std::vector<SurfacePlace>& places);
/// For an instruction set by name, or the machine's best for "".
KeepLocal* keep_local_for(const std::string& instruction_set);

} // namespace mane
