/// The styles as designed are at rest (M44): frame 1 stays.

#include "mane/scene.h"
#include "mane/setup.h"
#include "mane/world.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace mane;

TEST_CASE("a style at rest drifts by less than 1 % of its length in 5 s") {
    for (const char* style : {"short", "medium", "long"}) {
        CAPTURE(style);
        SceneDesc scene = read_scene(MANE_SOURCE_DIR "/scenes/" + std::string(style) + ".toml");
        scene.motion.still = true;
        scene.simulation.wisps.mode = WispContactMode::off;
        scene.simulation.schedule.preroll = 0;

        const RunSetup setup = prepare(scene);
        const Groom& groom = setup.groom;
        World world(scene.simulation, groom, setup.bodies);
        const Frame first = world.frame();
        while (world.frame().time < 5)
            world.advance();

        double worst = 0;
        const Vec3d shift = world.frame().origin - first.origin;
        for (std::size_t w = 0; w < groom.wisp_count(); ++w) {
            const std::uint32_t root = groom.first_section[w] + 1, end = groom.first_section[w + 1];
            double wisp_length = 0, drift = 0;
            for (std::uint32_t s = root + 1; s < end; ++s) {
                wisp_length += length(Vec3d(groom.position[s]) - Vec3d(groom.position[s - 1]));
                drift = std::max(drift, length(Vec3d(world.frame().position[s]) + shift -
                                               Vec3d(first.position[s])));
            }
            worst = std::max(worst, drift / wisp_length);
        }
        MESSAGE(std::string(style) << ": drifts by " << 100 * worst << " % of the length at most");
        CHECK(worst < 0.01);
    }
}
