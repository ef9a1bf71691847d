#include "mane/scene.h"

#include <doctest/doctest.h>

#include <algorithm>
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

/// A header without the comments that stand alone, so that what is left reads
/// `type name = default; ///< [unit] …`.
std::string read_header(const std::string& header) {
    std::ifstream in(std::string(MANE_SOURCE_DIR) + "/include/mane/" + header);
    REQUIRE(in);
    const std::regex comment(R"(^\s*(///([^<]|$)|//[^/]))");
    std::string text, line;
    while (std::getline(in, line))
        if (!std::regex_search(line, comment))
            text += line + "\n";
    return text;
}

/// Reads the members of every `struct …Desc` of a header. The plain way on purpose: the compiler
/// sees neither units nor members that the table forgot.
std::vector<Declared> declared_fields(const std::string& header) {
    const std::string text = read_header(header);
    const std::regex structure(R"(struct (\w+Desc) \{([^]*?)\n\};)");
    const std::regex member(
        R"(\n    ([\w:<>]+)\s+(\w+)(\s*=\s*[^;]*)?;([ \n]*///< *(\[([^\]]*)\])?)?)");
    std::vector<Declared> result;
    const std::sregex_iterator end;
    for (std::sregex_iterator s(text.begin(), text.end(), structure); s != end; ++s) {
        const std::string body = (*s)[2];
        for (std::sregex_iterator m(body.begin(), body.end(), member); m != end; ++m)
            if (!std::regex_search((*m)[1].str(),
                                   std::regex("Desc|vector"))) // sections of their own
                result.push_back({(*s)[1], (*m)[2], (*m)[6]});
    }
    return result;
}

struct Place {
    std::string header, section;
};
/// Where the members of each struct stand in a scene file.
const std::map<std::string, Place> kPlaces = {
    {"SimulationDesc", {"desc.h", "simulation"}},
    {"ScheduleDesc", {"desc.h", "schedule"}},
    {"SkeletonDesc", {"desc.h", "skeleton"}},
    {"EnvelopeDesc", {"desc.h", "envelope"}},
    {"StrandDesc", {"desc.h", "strands"}},
    {"AirDesc", {"desc.h", "air"}},
    {"WispContactDesc", {"desc.h", "wisps"}},
    {"CharacterContactDesc", {"desc.h", "character"}},
    {"StyleDesc", {"style.h", "style"}},
    {"CharacterDesc", {"scene.h", "character"}},
    {"MotionDesc", {"scene.h", "motion"}},
    {"ClipMotionDesc", {"character.h", "motion"}},
    {"CheckDesc", {"check.h", "check"}},
    {"ObstacleDesc", {"scene.h", "obstacle"}},
    {"ObstacleKeyDesc", {"scene.h", "obstacle.key"}},
};

} // namespace

TEST_CASE("every parameter is in the table, with the unit of its comment, and nothing else is") {
    std::set<std::string> found;
    for (const char* header : {"desc.h", "style.h", "character.h", "check.h", "scene.h"})
        for (const Declared& d : declared_fields(header)) {
            CAPTURE(d.structure);
            CAPTURE(d.name);
            REQUIRE(kPlaces.contains(d.structure));
            const Place& place = kPlaces.at(d.structure);
            CHECK(place.header == header);
            const auto field = std::ranges::find_if(all_fields(), [&](const FieldInfo* f) {
                return f->section == place.section && f->name == d.name;
            });
            REQUIRE(field != all_fields().end());
            if (!d.unit.empty() || (*field)->unit != "1")
                CHECK((*field)->unit == d.unit);
            found.insert((*field)->key());
        }
    for (const FieldInfo* f : all_fields()) {
        CAPTURE(f->key());
        CHECK(found.contains(f->key()));
    }
}

TEST_CASE(
    "keys are unique, help and units are given, numbers have a range that holds their default") {
    std::set<std::string> keys;
    for (const FieldInfo* info : all_fields()) {
        const FieldInfo& f = *info;
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
    for (const Field& f : fields_of<SceneDesc>()) {
        CAPTURE(f.key());
        SceneDesc scene;
        Value other = f.standard;
        if (auto* b = std::get_if<bool>(&other))
            *b = !*b;
        else if (auto* i = std::get_if<std::uint32_t>(&other))
            ++*i;
        else if (auto* x = std::get_if<float>(&other))
            *x += 1;
        else if (auto* d = std::get_if<double>(&other))
            *d += 1;
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
        for (const Field& g : fields_of<SceneDesc>())
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
    for (const FieldInfo* f : all_fields())
        CHECK(help.find("\n  " + std::string(f->name) + " ") != std::string::npos);
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
