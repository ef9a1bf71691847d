#include "mane/error.h"
#include "mane/scene.h"

#include <doctest/doctest.h>

using namespace mane;

namespace {

Value read(const char* section, const char* name, Literal literal) {
    return interpret(*find_field(section, name), literal, "here:1");
}

std::string failure(const char* section, const char* name, Literal literal) {
    try {
        read(section, name, std::move(literal));
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

Literal numbers(std::initializer_list<double> xs) {
    std::vector<Literal> items;
    for (const double x : xs)
        items.push_back({x});
    return {items};
}

} // namespace

TEST_CASE("numbers are read in the field's unit or with another unit that measures the same") {
    CHECK(std::get<float>(read("skeleton", "bending_length", {0.05})) == 0.05f);
    CHECK(std::get<float>(read("skeleton", "bending_length", {std::string("6 cm")})) == 0.06f);
    CHECK(std::get<float>(read("skeleton", "bending_length", {std::string("60mm")})) == 0.06f);
    CHECK(std::get<float>(read("skeleton", "strain", {std::string("0.5 %")})) == 0.005f);
    CHECK(std::get<float>(read("strands", "root_width", {std::string("80 µm")})) == 80e-6f);
    CHECK(std::get<float>(read("wisps", "parallel_angle", {std::string("1 rad")})) ==
          doctest::Approx(57.29578));
    CHECK(std::get<float>(read("schedule", "integration_rate", {std::string("1 kHz")})) == 1000.f);
    CHECK(std::get<float>(read("schedule", "preroll", {std::int64_t{2}})) == 2.f);
}

TEST_CASE("ramps are one number or two, vectors three, whole numbers whole") {
    CHECK(std::get<Ramp>(read("envelope", "stiffness", {0.5})) == Ramp(0.5f));
    CHECK(std::get<Ramp>(read("envelope", "stiffness", numbers({1, 0.5}))) == Ramp(1, 0.5f));
    CHECK(std::get<Vec3>(read("air", "wind", numbers({1, 2, 3}))) == Vec3(1, 2, 3));
    CHECK(std::get<std::uint32_t>(read("simulation", "seed", {std::int64_t{7}})) == 7u);
    CHECK(std::get<bool>(read("wisps", "literal", {true})));
    CHECK(std::get<std::string>(read("wisps", "mode", {std::string("off")})) == "off");
}

TEST_CASE("a value that cannot be says where, what was found and what was expected") {
    CHECK(failure("skeleton", "strain", {std::string("soft")}) ==
          "here:1: skeleton.strain: found \"soft\", expected a number from 0.0001 to 0.2");
    CHECK(failure("skeleton", "bending_length", {std::string("6 kg")}) ==
          "here:1: skeleton.bending_length: found \"6 kg\", expected a number from 0 to 1 [m]: "
          "\"kg\" is no unit for [m]");
    CHECK(failure("skeleton", "strain", {0.5}) ==
          "here:1: skeleton.strain: found 0.5, expected a number from 0.0001 to 0.2");
    CHECK(failure("skeleton", "strain", {std::nan("")}).find("found nan") != std::string::npos);
    CHECK(failure("schedule", "frames", {2.5}) ==
          "here:1: schedule.frames: found 2.5, expected a whole number from 1 to 1000000");
    CHECK(failure("simulation", "seed", {std::int64_t{-1}}).find("found -1") != std::string::npos);
    CHECK(failure("wisps", "literal", {std::int64_t{1}}) ==
          "here:1: wisps.literal: found 1, expected true or false");
    CHECK(failure("wisps", "mode", {std::string("on")}) ==
          "here:1: wisps.mode: found \"on\", expected one of \"off\", \"isotropic\", "
          "\"anisotropic\"");
    CHECK(failure("air", "wind", numbers({1, 2})) ==
          "here:1: air.wind: found [1, 2], expected [x, y, z], each from -100 to 100 [m/s]");
    CHECK(failure("envelope", "stiffness", numbers({1, 2, 3})).find("a number or [root, tip]") !=
          std::string::npos);
    CHECK(failure("skeleton", "strain", {true}).find("found true") != std::string::npos);
}

TEST_CASE("the nearest known name is suggested, also from another section") {
    CHECK(suggestion("skeleton", "strian") == " (did you mean skeleton.strain?)");
    CHECK(suggestion("air", "darg") == " (did you mean air.drag?)");
    CHECK(suggestion("obstacle", "sise") == " (did you mean obstacle.size?)");
    CHECK(suggestion("skeleton", "bendinglength") == " (did you mean skeleton.bending_length?)");
    CHECK(suggestion("skeleton", "gravity") == " (did you mean simulation.gravity?)");
    CHECK(suggestion("air", "friction").find("friction?)") != std::string::npos);
    CHECK(suggestion("air", "xyzzy_plugh") == " (known: drag, wind, gusts, gust_size, gust_seed)");
}

TEST_CASE("values written as TOML keep their bits and their type") {
    CHECK(to_toml(Value(0.1f)) == "0.1");
    CHECK(to_toml(Value(3.f)) == "3.0");
    CHECK(to_toml(Value(1e-9f)) == "1e-09");
    CHECK(to_toml(Value(80e-6f)) == "0.00008");
    CHECK(to_toml(Value(Ramp(1, 0.25f))) == "[1.0, 0.25]");
    CHECK(to_toml(Value(std::string("a \"b\" \\ \n"))) == "\"a \\\"b\\\" \\\\ \\u000a\"");
}

TEST_CASE("rates presets set the three rates; the literal one also what the paper prints") {
    SceneDesc scene;
    apply_rates(scene, "paper-literal");
    CHECK(scene.simulation.schedule.wisp_rate == 24.f);
    CHECK_FALSE(scene.simulation.schedule.hold_contacts);
    CHECK(scene.simulation.wisps.literal);
    apply_rates(scene, "fine");
    CHECK(scene.simulation.schedule.character_rate == 1000.f);
    CHECK(scene.simulation.schedule.hold_contacts);
    CHECK_THROWS_WITH_AS(apply_rates(scene, "fast"),
                         "rates \"fast\": expected one of default, paper, fine, paper-literal",
                         InputError);
}

TEST_CASE("overrides give their wisps other values, the later ones last") {
    SceneDesc scene;
    scene.overrides = {{{1, 2}, {{"skeleton.strain", 0.01f}, {"envelope.squeeze", 0.3f}}},
                       {{2}, {{"skeleton.strain", 0.02f}}}};
    CHECK(scene_of_wisp(scene, 0).hair.skeleton.strain == scene.hair.skeleton.strain);
    CHECK(scene_of_wisp(scene, 1).hair.skeleton.strain == 0.01f);
    CHECK(scene_of_wisp(scene, 2).hair.skeleton.strain == 0.02f);
    CHECK(scene_of_wisp(scene, 2).hair.envelope.squeeze == 0.3f);
}

TEST_CASE("conditions between fields are checked") {
    SceneDesc scene;
    scene.simulation.character.push_out = 0.005f;
    CHECK_THROWS_WITH_AS(check_scene(scene, "a.toml"),
                         "a.toml: found character.push_out = 0.005 and character.threshold = "
                         "0.004, expected the first not above the second",
                         InputError);
}
