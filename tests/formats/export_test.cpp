#include "mane/export.h"

#include "mane/error.h"

#include <cstring>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

using namespace mane;
namespace fs = std::filesystem;

namespace {

// A folder of this test alone, gone when it ends.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("mane_export_" + std::to_string(getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
};

std::string bytes_of(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream all;
    all << in.rdbuf();
    return all.str();
}

template <typename T> T number_at(const std::string& bytes, std::size_t offset) {
    T x;
    std::memcpy(&x, bytes.data() + offset, sizeof x);
    return x;
}

const Vec3d kOrigin{1, 2, 3};

Curves three_strands(bool alike) {
    Curves c;
    c.first_vertex =
        alike ? std::vector<std::uint32_t>{0, 3, 6, 9} : std::vector<std::uint32_t>{0, 2, 6, 9};
    for (int i = 0; i < 9; ++i) {
        const float x = static_cast<float>(i);
        c.position.push_back({0.5f * x, -0.25f * x, 0.125f});
        c.width.push_back(1e-4f - 1e-5f * x);
    }
    return c;
}

Mesh tetrahedron() {
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
            {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

// A reader of HAIR files from their description alone.
Curves read_hair(const std::string& file) {
    REQUIRE(file.size() >= 128);
    REQUIRE(file.compare(0, 4, "HAIR") == 0);
    const auto strands = number_at<std::uint32_t>(file, 4),
               points = number_at<std::uint32_t>(file, 8);
    const auto arrays = number_at<std::uint32_t>(file, 12);
    Curves c{{0}, {}, {}};
    std::size_t at = 128;
    for (std::uint32_t s = 0; s < strands; ++s) {
        std::uint32_t segments = number_at<std::uint32_t>(file, 16);
        if (arrays & 1)
            segments = number_at<std::uint16_t>(file, at), at += 2;
        c.first_vertex.push_back(c.first_vertex.back() + segments + 1);
    }
    REQUIRE((arrays & 2) != 0);
    for (std::uint32_t p = 0; p < points; ++p, at += 12)
        c.position.push_back({number_at<float>(file, at), number_at<float>(file, at + 4),
                              number_at<float>(file, at + 8)});
    for (std::uint32_t p = 0; p < points; ++p) {
        c.width.push_back(arrays & 4 ? number_at<float>(file, at) : number_at<float>(file, 20));
        if (arrays & 4)
            at += 4;
    }
    CHECK(at == file.size());
    CHECK(c.first_vertex.back() == points);
    return c;
}

} // namespace

TEST_CASE("export: HAIR files hold the strands, with and without an array of segments") {
    const Folder folder;
    for (const bool alike : {true, false}) {
        const Curves strands = three_strands(alike);
        write_curves(strands, kOrigin, folder.path / "out.hair");
        const std::string file = bytes_of(folder.path / "out.hair");
        CHECK((number_at<std::uint32_t>(file, 12) & 1) == (alike ? 0u : 1u));
        const Curves read = read_hair(file);
        CHECK(read.first_vertex == strands.first_vertex);
        CHECK(read.width == strands.width);
        for (std::size_t v = 0; v < 9; ++v)
            CHECK(read.position[v] == strands.position[v] + Vec3{1, 2, 3});
        CHECK(!fs::exists(folder.path / "out.hair.part"));
    }
}

TEST_CASE("export: a strand too long for a HAIR file is said, and leaves no file") {
    const Folder folder;
    Curves strand;
    strand.first_vertex = {0, 70000};
    strand.position.resize(70000);
    strand.width.resize(70000);
    CHECK_THROWS_WITH_AS(
        write_curves(strand, {}, folder.path / "out.hair"),
        "a HAIR file holds at most 65535 segments a strand, found 69999 in strand 0", InputError);
    CHECK(fs::is_empty(folder.path));
}

TEST_CASE("export: PLY") {
    const Folder folder;
    write_curves(three_strands(false), kOrigin, folder.path / "strands.ply");
    const std::string strands = bytes_of(folder.path / "strands.ply");
    CHECK(strands.find("element vertex 9\n") != std::string::npos);
    CHECK(strands.find("element edge 6\n") != std::string::npos); // 9 vertices in 3 curves
    const std::size_t data = strands.find("end_header\n") + 11;
    CHECK(strands.size() == data + 9 * 16 + 6 * 8);
    CHECK(number_at<float>(strands, data + 4 * 16) == 1 + 0.5f * 4);
    CHECK(number_at<float>(strands, data + 4 * 16 + 12) == 1e-4f - 1e-5f * 4);
    const std::size_t edges =
        data + 9 * 16; // the second begins the second strand: 1 and 2 are not joined
    CHECK(number_at<std::uint32_t>(strands, edges) == 0);
    CHECK(number_at<std::uint32_t>(strands, edges + 4) == 1);
    CHECK(number_at<std::uint32_t>(strands, edges + 8) == 2);

    write_mesh(tetrahedron(), kOrigin, folder.path / "mesh.ply");
    const std::string mesh = bytes_of(folder.path / "mesh.ply");
    CHECK(mesh.find("element face 4\n") != std::string::npos);
    const std::size_t vertices = mesh.find("end_header\n") + 11, faces = vertices + 4 * 12;
    CHECK(mesh.size() == faces + 4 * 13);
    CHECK(number_at<float>(mesh, vertices + 3 * 12 + 8) == 4);
    CHECK(mesh[faces + 13] == 3);
    CHECK(number_at<std::uint32_t>(mesh, faces + 13 + 9) == 3); // last corner of the second
}

TEST_CASE("export: OBJ") {
    const Folder folder;
    write_curves(three_strands(false), {}, folder.path / "strands.obj");
    const std::string strands = bytes_of(folder.path / "strands.obj");
    CHECK(strands.find("v 0.5 -0.25 0.125\n") != std::string::npos);
    CHECK(strands.find("l 1 2\nl 3 4 5 6\nl 7 8 9\n") != std::string::npos);
    write_mesh(tetrahedron(), kOrigin, folder.path / "mesh.obj");
    CHECK(bytes_of(folder.path / "mesh.obj") == "# mane; metres, Y up\nv 1 2 3\nv 2 2 3\nv 1 3 "
                                                "3\nv 1 2 4\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
}

TEST_CASE("export: what cannot be written is said with its path and the reason") {
    const Folder folder;
    const auto message = [](const auto& write) {
        try {
            write();
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("no error");
    };
    const fs::path nowhere = folder.path / "missing" / "a.obj";
    CHECK(message([&] { write_mesh(tetrahedron(), {}, nowhere); }) ==
          "cannot write " + nowhere.string() + ": No such file or directory");
    CHECK(message([&] { write_mesh(tetrahedron(), {}, "a.hair"); }) ==
          "cannot write a.hair: '.hair' is no format for meshes, expected .ply or .obj");
    CHECK(message([&] { write_curves(three_strands(true), {}, "a.abc"); }) ==
          "cannot write a.abc: '.abc' is no format for curves, expected .hair, .ply or .obj");

    if (!fs::exists("/dev/full")) {
        MESSAGE("skipped: /dev/full missing, a full disk is not tried");
        return;
    }
    CHECK(message([&] {
              const fs::path full =
                  folder.path / "full.obj"; // a link, as the ending tells the format
              fs::create_symlink("/dev/full", full);
              write_mesh(tetrahedron(), {}, full);
          }) ==
          "cannot write " + (folder.path / "full.obj").string() + ": No space left on device");
}
