#include "formats/page_payload.h"
#include "mane/cache.h"
#include "mane/error.h"
#include "mane/page.h"
#include "mane/scene.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

using namespace mane;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path =
        fs::temp_directory_path() / ("mane_page_" + std::to_string(std::random_device{}()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

/// A payload as docs/view.md says that it is read.
struct Unpacked {
    std::string bytes;
    nlohmann::json header;
    std::size_t arrays = 0;

    explicit Unpacked(const std::string& packed) {
        bytes.resize(packed.size() * 50 + 100000);
        uLongf size = bytes.size();
        REQUIRE(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                           reinterpret_cast<const Bytef*>(packed.data()), packed.size()) == Z_OK);
        bytes.resize(size);
        REQUIRE(bytes.substr(0, 8) == "MANEPAGE");
        std::uint32_t version = 0, length = 0;
        std::memcpy(&version, bytes.data() + 8, 4);
        std::memcpy(&length, bytes.data() + 12, 4);
        CHECK(version == 1);
        header = nlohmann::json::parse(bytes.substr(16, length));
        arrays = (16 + length + 7) / 8 * 8;
    }
    const nlohmann::json& entry(const std::string& name) const {
        for (const nlohmann::json& e : header["arrays"])
            if (e["name"] == name)
                return e;
        FAIL("no array ", name);
        return header;
    }
    template <typename T> std::vector<T> numbers(const std::string& name) const {
        const nlohmann::json& e = entry(name);
        std::vector<T> values(e["count"].get<std::size_t>());
        std::memcpy(values.data(), bytes.data() + arrays + e["offset"].get<std::size_t>(),
                    values.size() * sizeof(T));
        return values;
    }
    std::vector<std::uint32_t> planes(const std::string& name) const {
        const nlohmann::json& e = entry(name);
        const std::size_t count = e["count"], offset = e["offset"], n = e["planes"];
        std::vector<std::uint32_t> values(count);
        for (std::size_t plane = 0; plane < n; ++plane)
            for (std::size_t i = 0; i < count; ++i)
                values[i] |= std::uint32_t{static_cast<unsigned char>(
                                 bytes[arrays + offset + plane * count + i])}
                             << (8 * plane);
        return values;
    }
    std::vector<double> steps(const std::string& name) const {
        const std::size_t row = entry(name)["row"];
        const double quantum = entry(name)["quantum"];
        std::vector<std::uint32_t> whole = planes(name);
        std::vector<double> values(whole.size());
        for (std::size_t i = 0; i < whole.size(); ++i) {
            const std::uint32_t before = i < row ? 0 : whole[i - row],
                                before_that = i < 2 * row ? 0 : whole[i - 2 * row];
            whole[i] = ((whole[i] >> 1) ^ (0u - (whole[i] & 1))) + 2 * before - before_that;
            values[i] = quantum * static_cast<std::int32_t>(whole[i]);
        }
        return values;
    }
};

/// Two wisps of four sections under a scene of defaults, moving in an uneven way.
struct SmallRun {
    RunSetup setup;
    std::vector<Frame> frames;
    BodyPoses poses{{{{0, 1.5, 0}, {0, 0, 0, 1}, {}, {}}}};

    SmallRun() {
        setup.scene = write_scene({});
        Groom& g = setup.groom;
        g.first_section = {0, 4, 8};
        g.roots.assign(2, {});
        g.strands = {30, 70};
        for (int s = 0; s < 8; ++s)
            g.position.push_back(
                {0.1f * static_cast<float>(s / 4), -0.03f * static_cast<float>(s % 4), 0});
        g.radius.assign(32, 0.01f);
        g.rest_length.assign(8, 0.03f);
        setup.bodies = {
            {"peg", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, {}, nullptr, 0, false}};
        std::mt19937 random(7);
        std::uniform_real_distribution<float> uniform(-0.3f, 0.3f);
        for (std::uint32_t i = 0; i < 5; ++i) {
            Frame f;
            f.index = i;
            f.time = i / 24.0;
            f.origin = {0.0625 * i, 1.5, -1234.5};
            f.first_axis.assign(2, {1, 0, 0});
            for (int s = 0; s < 8; ++s)
                f.position.push_back({uniform(random), uniform(random), uniform(random)});
            f.velocity.assign(8, {});
            for (int r = 0; r < 32; ++r)
                f.radius.push_back(std::abs(uniform(random)) / 10);
            f.radius_rate.assign(32, 0);
            frames.push_back(f);
        }
    }
    /// As a cache; with the tables of `--record` where asked.
    CacheReader cache(const fs::path& file, bool record) const {
        CacheWriter writer(file, setup);
        for (const Frame& f : frames) {
            writer.add(f, poses);
            if (record)
                add_tables(writer, f.index);
        }
        writer.finish();
        return CacheReader(file);
    }
    using Whole = std::vector<std::uint32_t>;
    using Real = std::vector<float>;
    static void add_tables(CacheWriter& writer, std::uint32_t frame) {
        const float x = frame == 3 ? -2e-6f : 5e-7f;
        const Column contacts[] = {
            {"kind", "1", Whole{0, 1, 2}},       {"section", "1", Whole{2, 6, 3}},
            {"point", "1", Whole{0, 255, 4}},    {"along", "1", Real{0, 0.5f, 0}},
            {"other", "1", Whole{5, 1, 77}},     {"other_along", "1", Real{1, 0.25f, 0}},
            {"body", "1", Whole{0, 0, 0}},       {"impulse_x", "N s", Real{x, 0, 0}},
            {"impulse_y", "N s", Real{0, 0, 0}}, {"impulse_z", "N s", Real{0, 0, -3e-4f}}};
        writer.add_table("CONT", frame, contacts);
        const Column reactions[] = {{"section", "1", Whole{7}}, {"point", "1", Whole{0}},
                                    {"body", "1", Whole{0}},    {"triangle", "1", Whole{12}},
                                    {"shift_x", "m", Real{0}},  {"shift_y", "m", Real{0.002f}},
                                    {"shift_z", "m", Real{0}}};
        writer.add_table("REAC", frame, reactions);
    }
};

} // namespace

TEST_CASE("base64 is RFC 4648's") {
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foob") == "Zm9vYg==");
    CHECK(base64("\xff\xfe\xfd") == "//79");
}

TEST_CASE("a page's frames are the cache's, to half a step") {
    const Folder folder;
    const SmallRun run;
    const CacheReader cache = run.cache(folder.path / "a.mane", false);
    const Unpacked page(page_data(cache, {"a", {}, {}}));
    CHECK(page.header["title"] == "a");
    CHECK(page.header["wisps"] == 2);
    CHECK(page.numbers<std::uint32_t>("strands") == run.setup.groom.strands);
    CHECK(page.numbers<float>("designed_length")[1] == doctest::Approx(0.03));
    CHECK(page.numbers<float>("designed_length")[3] == 0); // nothing behind a tip
    const std::vector<double> position = page.steps("position"), radius = page.steps("radius");
    REQUIRE(position.size() == 5 * 24);
    for (std::size_t i = 0; i < 5; ++i)
        for (std::size_t s = 0; s < 8; ++s) {
            const Vec3d p = Vec3d(run.frames[i].position[s]) + run.frames[i].origin;
            const double* q = position.data() + 24 * i + 3 * s;
            CHECK(std::abs(q[0] - p.x) < 0.5001e-6);
            CHECK(std::abs(q[1] - p.y) < 0.5001e-6);
            CHECK(std::abs(q[2] - p.z) < 0.5001e-6);
            CHECK(std::abs(radius[32 * i + s] - double{run.frames[i].radius[s]}) < 0.5001e-6);
        }
    for (const nlohmann::json& e : page.header["arrays"])
        CHECK(e["name"].get<std::string>().substr(0, 7) != "contact");
}

TEST_CASE("a page has the contacts and penetration reactions of a recorded run") {
    const Folder folder;
    const SmallRun run;
    const Unpacked page(page_data(run.cache(folder.path / "a.mane", true), {}));
    CHECK(page.planes("contact.count") == std::vector<std::uint32_t>(5, 4));
    const auto frame_3 = [&](const char* name) {
        const std::vector<std::uint32_t> all = page.planes(name);
        return std::vector<std::uint32_t>(all.begin() + 12, all.begin() + 16);
    };
    CHECK(frame_3("contact.kind") == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK(frame_3("contact.point") == std::vector<std::uint32_t>{0, 255, 4, 0});
    CHECK(frame_3("contact.other") == std::vector<std::uint32_t>{5, 1, 77, 12});
    CHECK(frame_3("contact.along") == std::vector<std::uint32_t>{0, 128, 0, 0});
    std::uint32_t section = 0;
    std::vector<std::uint32_t> sections;
    for (const std::uint32_t step : frame_3("contact.section"))
        sections.push_back(section += step);
    CHECK(sections == std::vector<std::uint32_t>{2, 6, 3, 7});

    const double per_octave = page.header["contacts"]["strength_steps_per_octave"],
                 weakest = page.header["contacts"]["weakest_octave"];
    const std::vector<std::uint32_t> strength = frame_3("contact.strength");
    const double expected[] = {2e-6, 0, 3e-4, 0.002};
    for (std::size_t i = 0; i < 4; ++i) {
        const double found = strength[i] ? std::exp2(strength[i] / per_octave + weakest) : 0;
        CHECK(found == doctest::Approx(expected[i]).epsilon(0.011));
    }
    // −x, nothing, −z (any corner of the unfolded octahedron), +y
    CHECK(frame_3("contact.direction_x")[0] == 0);
    CHECK(frame_3("contact.direction_y")[0] == 127);
    CHECK(frame_3("contact.direction_x")[2] % 254 == 0);
    CHECK(frame_3("contact.direction_y")[2] % 254 == 0);
    CHECK(frame_3("contact.direction_x")[3] == 127);
    CHECK(frame_3("contact.direction_y")[3] == 254);
}

TEST_CASE("a page is the template with the data in its place; what does not fit is refused") {
    const Folder folder;
    SmallRun run;
    const CacheReader cache = run.cache(folder.path / "a.mane", false);
    const fs::path file = folder.path / "page.html";
    write_page(cache, {}, "before<!-- data -->after", file);
    std::ifstream in(file);
    const std::string page{std::istreambuf_iterator<char>(in), {}};
    CHECK(page.substr(0, 14) == "before<script ");
    CHECK(page.substr(page.size() - 14) == "</script>after");
    CHECK(page.find("eJ") != std::string::npos); // how zlib's streams begin

    CHECK_THROWS_AS(write_page(cache, {}, "no place", file), InputError);
    const FrameSeries series{"energy", "J", {1, 2}};
    CHECK_THROWS_WITH_AS(page_data(cache, {"a", {series}, {}}),
                         "series \"energy\" has 2 values, expected 5", InputError);
    run.frames[2].position[1].x = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH_AS(page_data(run.cache(folder.path / "b.mane", false), {}),
                         "frame 2 has a position that is not finite or too far away for a page",
                         InputError);
    run.frames.clear();
    CHECK_THROWS_WITH_AS(page_data(run.cache(folder.path / "c.mane", false), {}),
                         "the cache holds no frames", InputError);
}
