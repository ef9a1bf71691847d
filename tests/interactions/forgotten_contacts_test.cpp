/// A detection that forgets what it found decides as a new one does (M23 without the hysteresis).

#include "interactions/contact_geometry.h"
#include "interactions/wisp_detection.h"
#include "reference/random_groom.h"
#include "step/core_hair.h"

#include <doctest/doctest.h>

using namespace mane;

TEST_CASE("forgotten contacts have no say in what contacts are now") {
    int remembered = 0, all = 0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const reference::RandomHair recipe{
            .seed = seed, .wisps = 20, .points = 4, .most_sections = 9, .spread = 0.03};
        const Groom groom = random_groom(recipe);
        CoreHair core(groom);
        const Frame frame = random_state(recipe, groom, 1);
        reference::Hair twin(groom);
        set_state(twin, frame);
        core.take(frame);
        core.take(all_frames(twin));
        Threads threads(1);
        WispContactDesc wide; // all that could slide does
        wide.sliding_speed = 1e3f;
        wide.parallel_angle = 80;
        const WispContactDesc narrow{.hysteresis = 3};
        const auto kinds = [&](WispDetection& detection) {
            ContactGeometry geometry;
            geometry.take(core.view(), threads);
            detection.detect(core.view(), geometry.points(), threads);
            std::vector<WispContactKind> list;
            for (const WispContact& c : detection.list().all(geometry.points().order))
                list.push_back(c.kind);
            return list;
        };
        WispDetection fresh(narrow), forgetting(wide), remembering(wide);
        const auto expected = kinds(fresh);
        kinds(forgetting);
        forgetting.change(narrow);
        forgetting.forget();
        CHECK(forgetting.list().size() == 0);
        CHECK(kinds(forgetting) == expected);
        kinds(remembering);
        remembering.change(narrow);
        const auto found = kinds(remembering);
        REQUIRE(found.size() == expected.size());
        for (std::size_t i = 0; i < found.size(); ++i, ++all)
            remembered += found[i] != expected[i];
    }
    CHECK(all > 500);
    CHECK(remembered > 20); // else there was nothing to forget
}
