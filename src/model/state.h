#pragma once

#include "model/rest_rows.h"

namespace mane {

/// What moves: written every step. Positions are relative to the world's origin.
struct State {
    Rows position;    ///< [m]
    Rows velocity;    ///< [m/s]
    Rows radius;      ///< [m] K per section
    Rows radius_rate; ///< [m/s] K per section

    State() = default;
    State(std::size_t rows, std::uint32_t k)
        : position(rows, 3), velocity(rows, 3), radius(rows, k), radius_rate(rows, k) {}
};

/// The sections' frames (M8), found from the present curve at the beginning of each step.
struct SectionFrames {
    Rows u;      ///< first axis
    Rows v;      ///< second axis
    Rows normal; ///< u × v, toward the tip

    SectionFrames() = default;
    explicit SectionFrames(std::size_t rows) : u(rows, 3), v(rows, 3), normal(rows, 3) {}
};

/// The half line d_k in its section's axes: cos(2πk/K), sin(2πk/K).
struct HalfLine {
    float cosine = 1;
    float sine = 0;
};
/// The half lines of a section with `k` envelope points.
std::vector<HalfLine> half_lines(std::uint32_t k);

/// What the interactions may see of the hair: the state and its frames, and the rest data. They
/// write elsewhere.
struct HairView {
    const Groom& groom;
    const Layout& layout;
    const RestRows& rest;
    const State& state;
    const SectionFrames& frames;
    std::span<const HalfLine> half_lines;
};

} // namespace mane
