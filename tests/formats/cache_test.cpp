#include "mane/cache.h"
#include "mane/error.h"

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

using namespace mane;
namespace fs = std::filesystem;

namespace {

/// A folder of the test's own, removed at its end.
struct Folder {
    fs::path path =
        fs::temp_directory_path() / ("mane_cache_" + std::to_string(std::random_device{}()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    fs::path operator/(const char* name) const { return path / name; }
};

using Generator = std::mt19937;

template <typename T> void fill(std::vector<T>& values, std::size_t count, Generator& random) {
    values.resize(count);
    std::uniform_real_distribution<float> uniform(-1, 1);
    for (T& v : values) {
        if constexpr (std::is_same_v<T, Vec3>)
            v = {uniform(random), uniform(random), uniform(random)};
        else
            v = static_cast<T>(uniform(random));
    }
}

RunSetup random_setup(std::uint32_t wisps, std::uint32_t sections, Generator& random) {
    RunSetup setup;
    setup.scene = "[skeleton]\nstrain = 0.005 # ε\n";
    Groom& g = setup.groom;
    for (std::uint32_t w = 0; w <= wisps; ++w)
        g.first_section.push_back(w * sections);
    const std::size_t n = std::size_t{wisps} * sections;
    std::vector<Vec3> ends;
    fill(ends, wisps, random);
    for (std::uint32_t w = 0; w < wisps; ++w)
        g.roots.push_back({w, {1, 0, 0}, ends[w], -ends[w], {0, 0, 1}});
    g.strands.assign(wisps, 1000);
    fill(g.thickness_power, wisps, random);
    fill(g.position, n, random);
    for (auto* column : {&g.skeleton_mass, &g.envelope_mass, &g.stretch_stiffness,
                         &g.stretch_damping, &g.rest_length, &g.bend_stiffness, &g.bend_damping,
                         &g.rest_curvature_u, &g.rest_curvature_v, &g.radial_stiffness,
                         &g.radial_damping, &g.ring_stiffness, &g.ring_damping})
        fill(*column, n, random);
    for (auto* column : {&g.radius, &g.rest_radius, &g.ring_length})
        fill(*column, n * g.envelope_points, random);
    Body body;
    body.name = "bust";
    fill(body.mesh.vertices, 5, random);
    body.mesh.triangles = {{0, 1, 2}, {2, 3, 4}};
    body.skin.bones = {{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}, {1, 1, 0, 0}, {0, 1, 0, 0}};
    body.skin.weights.assign(5, {0.75f, 0.25f, 0, 0});
    body.head_bone = 1;
    setup.bodies = {body, Body{"hat", body.mesh, {}, nullptr, 0, true}};
    return setup;
}

Frame random_frame(std::uint32_t index, const Groom& groom, Generator& random) {
    Frame f;
    f.index = index;
    f.time = index / 24.0;
    f.origin = {0.1 * index, 1.5, 1.0 / 3};
    const std::size_t n = groom.section_count();
    fill(f.first_axis, groom.wisp_count(), random);
    fill(f.position, n, random);
    fill(f.velocity, n, random);
    fill(f.radius, n * groom.envelope_points, random);
    fill(f.radius_rate, n * groom.envelope_points, random);
    if (index == 1) { // bits that arithmetic would not keep
        f.position[0] = {-0.0f, 1e-42f, std::numeric_limits<float>::infinity()};
        f.radius[0] = std::numeric_limits<float>::quiet_NaN();
    }
    return f;
}

BodyPoses some_poses(double t) {
    const Quatd turn = normalized(Quatd{0, t, 0, 1});
    return {{{{0, 1, 0}, {}, {t, 0, 0}, {}}, {{t, 1.5, 0}, turn, {}, {0, 1, 0}}},
            {{{0, 1.7, 0}, turn, {}, {}}}};
}

template <typename T> bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same(const Frame& a, const Frame& b) {
    return a.index == b.index && a.time == b.time && a.origin == b.origin &&
           same_bits(a.first_axis, b.first_axis) && same_bits(a.position, b.position) &&
           same_bits(a.velocity, b.velocity) && same_bits(a.radius, b.radius) &&
           same_bits(a.radius_rate, b.radius_rate);
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& file, std::string_view bytes) {
    std::ofstream(file, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// A finished cache of `frames` frames, which are returned.
std::vector<Frame> write_cache(const fs::path& file, const RunSetup& setup, std::uint32_t frames,
                               Generator& random) {
    std::vector<Frame> written;
    CacheWriter writer(file, setup);
    for (std::uint32_t i = 0; i < frames; ++i) {
        written.push_back(random_frame(i, setup.groom, random));
        writer.add(written.back(), some_poses(i * 0.1));
    }
    writer.finish("{\"frames\": 1}");
    return written;
}

template <typename Call> std::string failure(const Call& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

} // namespace

TEST_CASE("a cache gives back every bit, frames in any order") {
    Folder folder;
    Generator random(1);
    const RunSetup setup = random_setup(7, 9, random);
    const std::vector<Frame> frames = write_cache(folder / "a.mane", setup, 5, random);
    CHECK_FALSE(fs::exists(folder / "a.mane.part"));

    const CacheReader reader(folder / "a.mane");
    CHECK(reader.damage().empty());
    CHECK(reader.version() == 1);
    CHECK(reader.setup().scene == setup.scene);
    CHECK(reader.statistics() == "{\"frames\": 1}");
    REQUIRE(reader.frame_count() == 5);
    for (const std::size_t i : {3u, 0u, 4u, 1u, 2u})
        CHECK(same(reader.frame(i), frames[i]));
    reader.verify();

    const Groom& g = reader.setup().groom;
    CHECK(g.first_section == setup.groom.first_section);
    CHECK(same_bits(g.position, setup.groom.position));
    CHECK(same_bits(g.ring_length, setup.groom.ring_length));
    CHECK(same_bits(g.bend_damping, setup.groom.bend_damping));
    CHECK(g.strands == setup.groom.strands);
    REQUIRE(g.wisp_count() == 7);
    CHECK(g.roots[6].triangle == 6);
    CHECK(g.roots[6].inside == setup.groom.roots[6].inside);
    CHECK(g.roots[6].outside == setup.groom.roots[6].outside);

    REQUIRE(reader.setup().bodies.size() == 2);
    CHECK(reader.setup().bodies[0].name == "bust");
    CHECK(reader.setup().bodies[0].mesh.triangles == setup.bodies[0].mesh.triangles);
    CHECK(reader.setup().bodies[0].skin.bones == setup.bodies[0].skin.bones);
    CHECK(reader.setup().bodies[0].head_bone == 1);
    CHECK(reader.setup().bodies[1].worn);
    CHECK(reader.poses(2)[0][1].rotation == some_poses(0.2)[0][1].rotation);
    CHECK(reader.poses(2)[0][0].velocity == some_poses(0.2)[0][0].velocity);
    CHECK(failure([&] { reader.frame(5); }).find("has no frame 5, expected one under 5") !=
          std::string::npos);
}

TEST_CASE("every member of the groom is stored") {
    // Writing what was read must give the same file: a forgotten array would make the second one
    // shorter.
    Folder folder;
    Generator random(2);
    const RunSetup setup = random_setup(3, 4, random);
    CacheWriter(folder / "a.mane", setup).finish();
    CacheWriter(folder / "b.mane", CacheReader(folder / "a.mane").setup()).finish();
    CHECK(bytes_of(folder / "a.mane") == bytes_of(folder / "b.mane"));
    // 20 arrays and the roots' five: as many members as groom.h declares.
    std::ifstream in(std::string(MANE_SOURCE_DIR) + "/include/mane/groom.h");
    std::size_t vectors = 0;
    for (std::string line; std::getline(in, line);)
        vectors += line.starts_with("    std::vector<");
    CHECK(vectors == 21);
}

TEST_CASE("vertices of bodies come from their poses, relative to the frame's origin") {
    Folder folder;
    Generator random(3);
    const RunSetup setup = random_setup(2, 4, random);
    const std::vector<Frame> frames = write_cache(folder / "a.mane", setup, 3, random);
    const CacheReader reader(folder / "a.mane");
    const std::vector<Vec3> vertices = reader.body_vertices(2, 0);
    const auto bones = some_poses(0.2)[0];
    REQUIRE(vertices.size() == 5);
    const Vec3d rest(setup.bodies[0].mesh.vertices[0]); // three quarters bone 0, one quarter bone 1
    const Vec3d expected = (rest + bones[0].position) * 0.75 +
                           (bones[1].rotation.rotate(rest) + bones[1].position) * 0.25 -
                           frames[2].origin;
    CHECK(length(Vec3d(vertices[0]) - expected) < 1e-6);
    // The hat has no skin: its one bone carries it.
    const Vec3d hat =
        some_poses(0.2)[1][0].rotation.rotate(rest) + Vec3d(0, 1.7, 0) - frames[2].origin;
    CHECK(length(Vec3d(reader.body_vertices(2, 1)[0]) - hat) < 1e-6);
}

TEST_CASE(
    "cut anywhere, a cache gives all frames that were finished, and says that it is not whole") {
    Folder folder;
    Generator random(4);
    const RunSetup setup = random_setup(2, 4, random);
    const std::vector<Frame> frames = write_cache(folder / "whole.mane", setup, 4, random);
    const std::string bytes = bytes_of(folder / "whole.mane");
    std::vector<std::uint64_t> ends;
    std::uint64_t setup_end = 0;
    const CacheReader whole(folder / "whole.mane");
    for (const ChunkInfo& c : whole.chunks()) {
        const std::uint64_t end = c.offset + 40 + c.stored;
        if (c.type == "FRAM")
            ends.push_back(end);
        else if (c.type != "STAT")
            setup_end = end;
    }
    REQUIRE(ends.size() == 4);
    for (std::size_t size = 0; size < bytes.size(); size += (size < setup_end ? 37 : 1)) {
        CAPTURE(size);
        write_bytes(folder / "cut.mane", std::string_view(bytes).substr(0, size));
        std::size_t expected = 0;
        for (const std::uint64_t end : ends)
            expected += end <= size;
        const std::string message = failure([&] {
            const CacheReader reader(folder / "cut.mane");
            CHECK(reader.frame_count() == expected);
            CHECK_FALSE(reader.damage().empty());
            for (std::size_t i = 0; i < expected; ++i)
                CHECK(same(reader.frame(i), frames[i]));
        });
        if (size >= setup_end)
            CHECK(message == "nothing");
        else if (size < 16)
            CHECK(message.find("bad magic") != std::string::npos);
        else if (message != "nothing")
            CHECK(message.find("is truncated: there is no whole chunk") != std::string::npos);
        else
            CHECK(size > 16);
    }
}

TEST_CASE("every flipped byte is found") {
    Folder folder;
    Generator random(5);
    const RunSetup setup = random_setup(2, 4, random);
    write_cache(folder / "whole.mane", setup, 2, random);
    const std::string bytes = bytes_of(folder / "whole.mane");
    std::size_t undetected = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::string flipped = bytes;
        flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
        write_bytes(folder / "flipped.mane", flipped);
        bool damaged = false;
        const std::string message = failure([&] {
            const CacheReader reader(folder / "flipped.mane");
            damaged = !reader.damage().empty();
            reader.verify();
        });
        undetected += message == "nothing" && !damaged;
    }
    CHECK(undetected == 0);
}

TEST_CASE("a damaged frame is named with its place, the others stay readable") {
    Folder folder;
    Generator random(6);
    const RunSetup setup = random_setup(2, 4, random);
    const std::vector<Frame> frames = write_cache(folder / "a.mane", setup, 3, random);
    std::uint64_t offset = 0;
    const CacheReader a(folder / "a.mane");
    for (const ChunkInfo& c : a.chunks())
        if (c.type == "FRAM" && c.number == 1)
            offset = c.offset;
    std::string bytes = bytes_of(folder / "a.mane");
    bytes[offset + 50] ^= 4;
    write_bytes(folder / "a.mane", bytes);
    const CacheReader reader(folder / "a.mane");
    CHECK(same(reader.frame(2), frames[2]));
    CHECK(failure([&] { reader.frame(1); }) == (folder / "a.mane").string() +
                                                   ": chunk FRAM 1 at byte " +
                                                   std::to_string(offset) + ": checksum mismatch");
}

TEST_CASE("other files and other versions are refused") {
    Folder folder;
    write_bytes(folder / "text.mane", "[skeleton]\nstrain = 0.005\n");
    CHECK(failure([&] {
              CacheReader reader(folder / "text.mane");
          }).find("is no .mane file (bad magic)") != std::string::npos);
    CHECK(failure([&] { CacheReader reader(folder / "none.mane"); }).find("cannot be read") !=
          std::string::npos);
    Generator random(7);
    CacheWriter(folder / "a.mane", random_setup(1, 3, random)).finish();
    std::string bytes = bytes_of(folder / "a.mane");
    bytes[8] = 7;
    write_bytes(folder / "a.mane", bytes);
    CHECK(failure([&] {
              CacheReader reader(folder / "a.mane");
          }).find("has format version 7, expected 1") != std::string::npos);
}

TEST_CASE("tables are kept under their type; readers that do not know it pass them by") {
    Folder folder;
    Generator random(8);
    const RunSetup setup = random_setup(2, 4, random);
    std::vector<Frame> frames;
    {
        CacheWriter writer(folder / "a.mane", setup);
        for (std::uint32_t i = 0; i < 3; ++i) {
            frames.push_back(random_frame(i, setup.groom, random));
            writer.add(frames.back(), some_poses(0));
            const Column table[] = {{"point", "", std::vector<std::uint32_t>{i, 2}},
                                    {"s", "1", std::vector<float>{0.5f}},
                                    {"t", "s", std::vector<double>{0.1}}};
            writer.add_table("XYZW", i, table);
        }
        writer.finish();
    }
    const CacheReader reader(folder / "a.mane");
    REQUIRE(reader.frame_count() == 3);
    CHECK(same(reader.frame(2), frames[2]));
    const std::vector<Column> table = reader.table("XYZW", 1);
    REQUIRE(table.size() == 3);
    CHECK(table[0].name == "point");
    CHECK(std::get<0>(table[0].values) == std::vector<std::uint32_t>{1, 2});
    CHECK(std::get<1>(table[1].values) == std::vector<float>{0.5f});
    CHECK(table[2].unit == "s");
    CHECK(reader.table("XYZW", 9).empty());
}

TEST_CASE("a run that is not finished leaves its frames in FILE.part and the old file alone") {
    Folder folder;
    Generator random(9);
    const RunSetup setup = random_setup(2, 4, random);
    write_cache(folder / "a.mane", setup, 1, random);
    const std::string before = bytes_of(folder / "a.mane");
    {
        CacheWriter writer(folder / "a.mane", setup);
        writer.add(random_frame(0, setup.groom, random), some_poses(0));
        writer.add(random_frame(1, setup.groom, random), some_poses(0));
        CHECK(CacheReader(folder / "a.mane.part").frame_count() == 2); // also while it runs
    }
    CHECK(bytes_of(folder / "a.mane") == before);
    CHECK(CacheReader(folder / "a.mane.part").frame_count() == 2);
    { CacheWriter writer(folder / "b.mane", setup); }
    CHECK_FALSE(fs::exists(folder / "b.mane"));
    CHECK_FALSE(fs::exists(folder / "b.mane.part"));
}

TEST_CASE("a full disk and a folder that is not there are said at once") {
    Folder folder;
    Generator random(10);
    const RunSetup setup = random_setup(2, 4, random);
    CHECK(failure([&] {
              CacheWriter writer(folder / "no/where.mane", setup);
          }).find("cannot be written: No such file or directory") != std::string::npos);
    if (!fs::exists("/dev/full")) {
        MESSAGE("skipped: /dev/full missing");
        return;
    }
    CHECK(failure([&] { CacheWriter writer("/dev/full", setup); }) ==
          "/dev/full: cannot be written: No space left on device");
    CHECK(fs::exists("/dev/full"));
}

TEST_CASE("frames that do not fit are refused") {
    Folder folder;
    Generator random(11);
    const RunSetup setup = random_setup(2, 4, random);
    CacheWriter writer(folder / "a.mane", setup);
    Frame frame = random_frame(0, setup.groom, random);
    CHECK(failure([&] { writer.add(frame, {}); }).find("does not fit") != std::string::npos);
    frame.radius.pop_back();
    CHECK(failure([&] { writer.add(frame, some_poses(0)); }).find("frame 0 does not fit") !=
          std::string::npos);
}

TEST_CASE("264 frames of 56 wisps of 9 sections in smooth motion take less than their raw size") {
    Folder folder;
    Generator random(12);
    const RunSetup setup = random_setup(56, 9, random);
    const Frame rest = random_frame(0, setup.groom, random);
    {
        CacheWriter writer(folder / "a.mane", setup);
        for (std::uint32_t i = 0; i < 264; ++i) {
            Frame f = rest;
            f.index = i;
            for (std::size_t s = 0; s < f.position.size(); ++s)
                f.position[s].x += 0.1f * static_cast<float>(std::sin(0.1 * i + double(s)));
            writer.add(f, some_poses(i * 0.01));
        }
        writer.finish();
    }
    const double raw = 264.0 * (504 * (24 + 32) + 56 * 12),
                 stored = static_cast<double>(fs::file_size(folder / "a.mane"));
    MESSAGE("264 frames of 56 × 9: " << stored / 1e6 << " MB, ratio " << raw / stored);
    CHECK(stored < raw);
}
