#include "mane/error.h"
#include "mane/scene.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace mane;

namespace {

SceneDesc parse(const std::string& text) {
    return parse_scene(text, "hair.toml", "scenes");
}

std::string failure(const std::string& text) {
    try {
        parse(text);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

std::string setting_failure(const std::string& setting) {
    SceneDesc scene;
    try {
        apply_setting(scene, setting);
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

} // namespace

TEST_CASE("a scene file sets what it names and leaves the rest at its default") {
    const SceneDesc scene = parse(R"(
[skeleton]
strain = 0.01
bending_length = "5 cm"
[envelope]
stiffness = [2, 0.5]
points = 6
[air]
wind = [1, 0, -2.5]
[wisps]
mode = "isotropic"
[schedule]
hold_contacts = false
)");
    CHECK(scene.hair.skeleton.strain == 0.01f);
    CHECK(scene.hair.skeleton.bending_length == 0.05f);
    CHECK(scene.hair.skeleton.bending_damping == SkeletonDesc{}.bending_damping);
    CHECK(scene.hair.envelope.stiffness == Ramp(2, 0.5f));
    CHECK(scene.hair.envelope.points == 6);
    CHECK(scene.simulation.air.wind == Vec3(1, 0, -2.5f));
    CHECK(scene.simulation.wisps.mode == WispContactMode::isotropic);
    CHECK_FALSE(scene.simulation.schedule.hold_contacts);
}

TEST_CASE("mistakes are found with file, line and key") {
    CHECK(failure("[skeleton]\n\nstrian = 1") ==
          "hair.toml:3: unknown key skeleton.strian (did you mean skeleton.strain?)");
    CHECK(failure("[skeletn]\nstrain = 1") ==
          "hair.toml:1: unknown section [skeletn] (did you mean [skeleton]?)");
    CHECK(failure("[skeleton]\nstrain = 1") ==
          "hair.toml:2: skeleton.strain: found 1, expected a number from 0.0001 to 0.2");
    CHECK(failure("[skeleton]\nbending_length = \"6 s\"")
              .starts_with("hair.toml:2: skeleton.bending_length: found \"6 s\""));
    CHECK(failure("skeleton = 3")
              .find("hair.toml:1: found a value, expected the section [skeleton]") == 0);
    CHECK(failure("[skeleton]\nstrain = 07:32:00") ==
          "hair.toml:2: found a table or a date, expected a value");
    CHECK(failure("[skeleton]\nstrain = \n").starts_with("hair.toml:2: "));
    CHECK(failure("[skeleton]\nstrain = 0.01\nstrain = 0.02").starts_with("hair.toml:3: "));
    CHECK(failure("[character]\npush_out = 0.01")
              .starts_with("hair.toml: found character.push_out = 0.01"));
}

TEST_CASE("overrides name wisps and fields that may differ between them") {
    const SceneDesc scene = parse(
        "[[override]]\nwisps = [3, 4]\nskeleton.strain = 0.01\nenvelope.stiffness = [1, 1]\n");
    REQUIRE(scene.overrides.size() == 1);
    CHECK(scene_of_wisp(scene, 4).hair.skeleton.strain == 0.01f);
    CHECK(scene_of_wisp(scene, 5).hair.skeleton.strain == SkeletonDesc{}.strain);
    CHECK(failure("[[override]]\nskeleton.strain = 0.01")
              .starts_with("hair.toml:1: [[override]] without wisps"));
    CHECK(failure("[[override]]\nwisps = [-1]").starts_with("hair.toml:2: override.wisps"));
    CHECK(failure("[[override]]\nwisps = [1]\nschedule.frames = 3") ==
          "hair.toml:3: schedule.frames is one for all wisps, no [[override]] can set it");
    CHECK(failure("[override]\nwisps = [1]") ==
          "hair.toml:1: expected [[override]] with two brackets");
}

TEST_CASE("settings take a value as in a scene file, or bare") {
    SceneDesc scene;
    apply_setting(scene, "skeleton.strain=0.02");
    apply_setting(scene, "skeleton.bending_length=6cm");
    apply_setting(scene, "wisps.mode=off");
    apply_setting(scene, "air.wind=[1, 0, 0]");
    apply_setting(scene, "schedule.hold_contacts=false");
    CHECK(scene.hair.skeleton.strain == 0.02f);
    CHECK(scene.hair.skeleton.bending_length == 0.06f);
    CHECK(scene.simulation.wisps.mode == WispContactMode::off);
    CHECK(scene.simulation.air.wind == Vec3(1, 0, 0));
    CHECK_FALSE(scene.simulation.schedule.hold_contacts);

    CHECK(setting_failure("skeleton.strian=1") ==
          "--set skeleton.strian=1: unknown key skeleton.strian (did you mean skeleton.strain?)");
    CHECK(setting_failure("strain=1") == "--set strain=1: expected section.key=value");
    CHECK(setting_failure("skeleton.strain") ==
          "--set skeleton.strain: expected section.key=value");
    CHECK(setting_failure("skeleton.strain=x").find("found \"x\", expected a number") !=
          std::string::npos);
    CHECK(setting_failure("skeleton.strain=0.01\nother = 3").find("expected a number") !=
          std::string::npos);
}

TEST_CASE("a scene that is written and read again is the same") {
    SceneDesc scene = parse("[[override]]\nwisps = [3, 4]\nskeleton.strain = 0.0123\n");
    scene.hair.skeleton.strain = 0.1f / 3;
    scene.hair.envelope.stiffness = {1.0f / 7, 3};
    scene.simulation.gravity = {1e-6f, -9.81f, 0};
    const SceneDesc again = parse(write_scene(scene));
    for (const Field& f : fields_of<SceneDesc>()) {
        CAPTURE(f.key());
        CHECK(f.get(again) == f.get(scene));
    }
    REQUIRE(again.overrides.size() == 1);
    CHECK(again.overrides[0].wisps == scene.overrides[0].wisps);
    CHECK(again.overrides[0].settings == scene.overrides[0].settings);
    CHECK(write_scene(again) == write_scene(scene));
}

TEST_CASE("the schema describes every field") {
    const auto schema = nlohmann::json::parse(scene_schema());
    for (const Field& f : fields_of<SceneDesc>()) {
        CAPTURE(f.key());
        const auto& field = schema.at("properties")
                                .at(std::string(f.section))
                                .at("properties")
                                .at(std::string(f.name));
        CHECK(field.at("description").get<std::string>().find(f.help) != std::string::npos);
        CHECK(field.contains("default"));
        CHECK(field.value("x-live", false) == has(f.use, FieldUse::live));
    }
    CHECK(schema["properties"]["skeleton"]["properties"]["strain"]["default"] == 0.005);
    CHECK(schema["properties"]["skeleton"]["additionalProperties"] == false);
    CHECK(
        schema["properties"]["override"]["items"]["properties"]["skeleton"]["properties"].contains(
            "strain"));
    CHECK_FALSE(schema["properties"]["override"]["items"]["properties"].contains("schedule"));
}

TEST_CASE("obstacles have a shape and keys; files are found from the scene's folder") {
    const SceneDesc scene = parse(R"(
[character]
mesh = "heads/one.obj"
unit = 0.01
[motion]
clip = "/clips/walk.bvh"
unit = 0.0564444
last = 1617
[[obstacle]]
name = "hand"
shape = "sphere"
size = [0.1, 0.2, 0.1]
[[obstacle.key]]
time = 1
position = [0, 1.5, "20 cm"]
rotation = [0, 90, 0]
[[obstacle.key]]
time = 2
[[obstacle]]
worn = true
)");
    CHECK(scene.character.mesh == "scenes/heads/one.obj");
    CHECK(scene.motion.clip == "/clips/walk.bvh");
    CHECK(scene.motion.drive.unit == 0.0564444); // all digits of a double
    CHECK(scene.motion.drive.last == 1617);
    REQUIRE(scene.obstacles.size() == 2);
    CHECK(scene.obstacles[0].name == "hand");
    CHECK(scene.obstacles[0].shape == ObstacleShape::sphere);
    REQUIRE(scene.obstacles[0].keys.size() == 2);
    CHECK(scene.obstacles[0].keys[0].position == Vec3(0, 1.5f, 0.2f));
    CHECK(scene.obstacles[1].worn);

    const std::string written = write_scene(scene);
    CHECK(write_scene(parse_scene(written, "again", "")) == written);

    CHECK(failure("[[obstacle]]\nsise = 3") ==
          "hair.toml:2: unknown key obstacle.sise (did you mean obstacle.size?)");
    CHECK(failure("[[obstacle]]\n[[obstacle.key]]\nplace = 3")
              .starts_with("hair.toml:3: unknown key obstacle.key.place"));
    CHECK(failure("[obstacle]\nworn = true") ==
          "hair.toml:1: expected [[obstacle]] with two brackets");
    CHECK(
        failure("[motion]\nfirst = 9\nlast = 3").starts_with("hair.toml: found motion.first = 9"));
}
