#pragma once

#include "mane/frame.h"
#include "mane/groom.h"

#include <cmath>
#include <random>

namespace mane::test {

/// Wisps that no simulation made: bends, stretches and squeezes beyond what it would do.
struct Hair {
    Groom groom;
    Frame frame;
};

struct HairRecipe {
    std::uint32_t wisps = 4;
    std::uint32_t sections = 9;
    std::uint32_t k = 4;
    double bend = 0.7;     ///< [rad] largest between two segments
    double squeeze = 0.8;  ///< [1] largest change of a radius
    double stretch = 0.3;  ///< [1] largest change of a segment's length, frame against groom
    double segment = 0.04; ///< [m]
    double radius = 0.012; ///< [m]
};

inline Hair random_hair(const HairRecipe& recipe, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    Hair hair;
    hair.groom.envelope_points = recipe.k;
    hair.groom.first_section.push_back(0);
    for (std::uint32_t w = 0; w < recipe.wisps; ++w) {
        Vec3d direction{0, -1, 0};
        Vec3d now{0.1 * u(random), 0.1 * u(random), 0.1 * u(random)}, designed = now;
        for (std::uint32_t i = 0; i < recipe.sections; ++i) {
            hair.groom.position.push_back(Vec3(designed));
            hair.frame.position.push_back(Vec3(now));
            for (std::uint32_t k = 0; k < recipe.k; ++k) {
                hair.groom.radius.push_back(static_cast<float>(recipe.radius));
                hair.frame.radius.push_back(
                    static_cast<float>(recipe.radius * (1 + recipe.squeeze * u(random))));
            }
            const Vec3d turn =
                normalized(cross(direction, Vec3d{u(random), u(random), u(random)})) *
                std::sin(recipe.bend * u(random) / 2);
            direction = normalized(
                Quatd{turn.x, turn.y, turn.z, std::sqrt(1 - dot(turn, turn))}.rotate(direction));
            designed += Vec3d{0, -recipe.segment, 0};
            now += direction * (recipe.segment * (1 + recipe.stretch * u(random)));
        }
        hair.frame.first_axis.push_back({1, 0, 0});
        hair.groom.roots.emplace_back();
        hair.groom.strands.push_back(100 + 10 * w);
        hair.groom.first_section.push_back(static_cast<std::uint32_t>(hair.groom.position.size()));
    }
    return hair;
}

/// One straight wisp hanging from the origin, as designed.
inline Hair straight_hair(std::uint32_t sections, float segment = 0.04f, float radius = 0.01f) {
    HairRecipe recipe;
    recipe.wisps = 1;
    recipe.sections = sections;
    recipe.bend = recipe.squeeze = recipe.stretch = 0;
    recipe.segment = segment;
    recipe.radius = radius;
    Hair hair = random_hair(recipe, 1);
    for (std::uint32_t i = 0; i < sections; ++i)
        hair.groom.position[i] = hair.frame.position[i] = {0, -segment * static_cast<float>(i), 0};
    return hair;
}

} // namespace mane::test
