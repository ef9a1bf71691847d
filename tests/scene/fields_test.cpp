#include "mane/scene.h"

#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

using namespace mane;

namespace {

/// A member of a struct as its header declares it.
struct Declared {
    std::string structure, name, unit;
};

/// Reads `type name = default; ///< [unit] …` in every `struct …Desc` of a header. The slow and
/// plain way on purpose: the compiler sees neither units nor members that the table forgot.
std::vector<Declared> declared_fields(const std::string& header) {
    std::ifstream in(std::string(MANE_SOURCE_DIR) + "/include/mane/" + header);
    REQUIRE(in);
    const std::regex structure(R"(^struct (\w+Desc) \{)"),
        member(R"(^    [\w:]+ (\w+)( = .*)?;\s*(///< (\[([^\]]*)\])?.*)?$)");
    std::vector<Declared> result;
    std::string line, current;
    std::smatch match;
    while (std::getline(in, line)) {
        if (std::regex_search(line, match, structure))
            current = match[1];
        else if (line == "};")
            current.clear();
        else if (!current.empty() && std::regex_match(line, match, member))
            result.push_back({current, match[1], match[5]});
    }
    return result;
}

/// The section of each struct of desc.h. SimulationDesc's own structs are sections of their own.
const std::map<std::string, std::string> kSections = {
    {"SkeletonDesc", "skeleton"},
    {"EnvelopeDesc", "envelope"},
    {"AirDesc", "air"},
    {"WispContactDesc", "wisps"},
    {"StrandDesc", "strands"},
    {"CharacterContactDesc", "character"},
    {"SimulationDesc", "simulation"},
    {"ScheduleDesc", "schedule"},
};

} // namespace

TEST_CASE("every parameter of desc.h is in the table, with the unit of its comment, and every "
          "section is a struct's") {
    std::set<std::string> found;
    for (const Declared& d : declared_fields("desc.h")) {
        CAPTURE(d.structure);
        CAPTURE(d.name);
        REQUIRE(kSections.contains(d.structure));
        if (d.structure == "SimulationDesc" && d.unit.empty())
            continue; // a struct with a section of its own
        const Field* field = find_field(kSections.at(d.structure), d.name);
        REQUIRE(field);
        CHECK(field->unit == d.unit);
        found.insert(field->key());
    }
    CHECK(found.size() >= 46);
    for (const Field& f : scene_fields()) {
        CAPTURE(f.key());
        CHECK(found.contains(f.key()));
    }
}

TEST_CASE(
    "keys are unique, help and units are given, numbers have a range that holds their default") {
    std::set<std::string> keys;
    for (const Field& f : scene_fields()) {
        CAPTURE(f.key());
        CHECK(keys.insert(f.key()).second);
        CHECK(f.help.size() > 10);
        const bool number = !std::holds_alternative<bool>(f.standard) &&
                            !std::holds_alternative<std::string>(f.standard);
        CHECK(number == !f.unit.empty());
        CHECK(number == (f.range.low < f.range.high && f.range.high < 1e12));
        if (const float* x = std::get_if<float>(&f.standard)) {
            CHECK(*x >= static_cast<float>(f.range.low));
            CHECK(*x <= static_cast<float>(f.range.high));
        }
    }
}

TEST_CASE("a field reads and writes its own member and no other") {
    const SceneDesc standard;
    for (const Field& f : scene_fields()) {
        CAPTURE(f.key());
        SceneDesc scene;
        Value other = f.standard;
        if (auto* b = std::get_if<bool>(&other))
            *b = !*b;
        else if (auto* i = std::get_if<std::uint32_t>(&other))
            ++*i;
        else if (auto* x = std::get_if<float>(&other))
            *x += 1;
        else if (auto* r = std::get_if<Ramp>(&other))
            r->tip += 1;
        else if (auto* v = std::get_if<Vec3>(&other))
            v->z += 1;
        else if (!f.choices.empty())
            other = std::string(f.choices[0] == std::get<std::string>(other) ? f.choices[1]
                                                                             : f.choices[0]);
        else
            other = std::string("x");
        f.set(scene, other);
        for (const Field& g : scene_fields())
            CHECK((g.get(scene) == g.get(standard)) == (g.key() != f.key()));
        CHECK(f.get(scene) == other);
    }
}

TEST_CASE("defaults are those of the structs") {
    CHECK(std::get<float>(find_field("skeleton", "strain")->standard) == SkeletonDesc{}.strain);
    CHECK(std::get<Ramp>(find_field("envelope", "stiffness")->standard) ==
          EnvelopeDesc{}.stiffness);
    CHECK(std::get<std::string>(find_field("wisps", "mode")->standard) == "anisotropic");
    CHECK(std::get<Vec3>(find_field("simulation", "gravity")->standard) ==
          SimulationDesc{}.gravity);
}

TEST_CASE("help names every field with its default and unit, in lines of at most 100 columns") {
    const std::string help = scene_help();
    for (const Field& f : scene_fields())
        CHECK(help.find("\n  " + std::string(f.name) + " ") != std::string::npos);
    CHECK(help.find("strain                0.005               [1]") != std::string::npos);
    std::size_t columns = 0;
    for (const char c : help) {
        columns = c == '\n' ? 0 : columns + ((c & 0xc0) != 0x80);
        if (columns > 118)
            FAIL_CHECK("a line of the help is too long");
    }
    CHECK(section_help("air").find("gust_size") != std::string::npos);
    CHECK(section_help("hair").empty());
}
