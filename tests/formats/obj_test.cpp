#include "clip_data.h"

#include "mane/error.h"
#include "mane/import.h"

using namespace mane;

namespace {

const std::string kTetrahedron = "# a tetrahedron\n"
                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                 "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::string error_of(const std::string& text) {
    const TextFile file("bad.obj", text);
    try {
        read_obj(file.path());
    } catch (const InputError& e) {
        return std::string(e.what()).substr(file.path().size());
    }
    return "no error";
}

bool starts(const std::string& text, const std::string& with) {
    return text.rfind(with, 0) == 0;
}

} // namespace

TEST_CASE("an OBJ file's vertices and triangles arrive in order, in metres") {
    const TextFile file("good.obj", kTetrahedron);
    MeshReport report;
    const Mesh mesh = read_obj(file.path(), 0.1, &report);
    REQUIRE(mesh.vertices.size() == 4);
    CHECK(mesh.vertices[1] == Vec3(0.1f, 0, 0));
    REQUIRE(mesh.triangles.size() == 4);
    CHECK(mesh.triangles[2] == std::array<std::uint32_t, 3>{1, 2, 3});
    CHECK(report.clean());
    CHECK(report.warning().empty());
}

TEST_CASE("OBJ polygons, slashes, negative indices, line ends and other statements") {
    const TextFile file(
        "forms.obj", "mtllib a.mtl\r\no cube\r\nv 0 0 0\r\nv +1 0 0\r\nv 1 1 0 1.0\r\nv 0 1e0 0\r\n"
                     "vt 0 0\r\nvn 0 0 1\r\ns 1\r\nf 1/1 2/1/1 3//1 -1 # a square\r\n"
                     "f -4/1/1 -3//1 -2");
    MeshReport report;
    const Mesh mesh = read_obj(file.path(), 1, &report);
    REQUIRE(mesh.triangles.size() == 3);
    CHECK(mesh.triangles[0] == std::array<std::uint32_t, 3>{0, 1, 2});
    CHECK(mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 2, 3});
    CHECK(mesh.triangles[2] == std::array<std::uint32_t, 3>{0, 1, 2});
    // the square's four sides: two are used twice in the same direction, two once; the diagonal
    // three times
    CHECK(report.open_edges == 2);
    CHECK(report.non_manifold_edges == 3);
    CHECK(report.warning() == "2 open edges, 3 non-manifold edges");
}

TEST_CASE("triangles that name a vertex twice are left out, flat ones stay, both are counted") {
    const TextFile file("flat.obj", kTetrahedron + "v 2 0 0\nf 1 2 2\nf 1 2 5\n");
    MeshReport report;
    CHECK(read_obj(file.path(), 1, &report).triangles.size() == 5);
    CHECK(report.dropped_triangles == 1);
    CHECK(report.flat_triangles == 1);
}

TEST_CASE("a bad OBJ file is refused with its line, what was found and what was expected") {
    CHECK(starts(error_of("v 0 0 0\nv 1 0\n"), ":2: vertex with 2 coordinates"));
    CHECK(starts(error_of("v 0 nan 0\n"), ":1: vertex coordinate \"nan\""));
    CHECK(starts(error_of("v 0 1e999 0\n"), ":1: vertex coordinate \"1e999\""));
    CHECK(starts(error_of("v 0 inf 0\n"), ":1: vertex coordinate \"inf\""));
    CHECK(starts(error_of("v 0 1x 0\n"), ":1: vertex coordinate \"1x\""));
    CHECK(starts(error_of(kTetrahedron + "f 1 2 5\n"),
                 ":10: polygon corner 5, but there are 4 vertices"));
    CHECK(starts(error_of(kTetrahedron + "f 1 2 -5\n"), ":10: polygon corner -5"));
    CHECK(starts(error_of(kTetrahedron + "f 0 1 2\n"), ":10: polygon corner 0"));
    CHECK(starts(error_of(kTetrahedron + "f 1 2 x\n"), ":10: polygon corner \"x\""));
    CHECK(starts(error_of(kTetrahedron + "f 1 2\n"), ":10: polygon with 2 corners"));
    CHECK(starts(error_of(""), ": no vertices"));
    CHECK(starts(error_of("v 0 0 0\nv 1 0 0\n"), ": no polygons in 2 lines"));
    CHECK(starts(error_of("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
                 ": all 1 triangles are without area"));
    CHECK(starts(error_of("v 0 0 0\nv 1 0 0\nf 1 2 2\n"), ": all 1 triangles are without area"));
    CHECK_THROWS_WITH_AS(read_obj("no/such.obj"),
                         "no/such.obj: cannot be opened; expected a readable file", InputError);
}

TEST_CASE("corners at the same position join: a seam of the texture does not open the surface") {
    const TextFile file("seam.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 -0\nv 1 0 0\n"
                                    "f 1 3 2\nf 5 6 4\nf 2 3 4\nf 3 1 4\n");
    MeshReport report;
    const Mesh mesh = read_obj(file.path(), 1, &report);
    CHECK(mesh.vertices.size() == 6);
    CHECK(mesh.triangles[1] == std::array<std::uint32_t, 3>{0, 1, 3});
    CHECK(report.clean());
}

TEST_CASE("real heads: as many open edges as are known of them") {
    const struct {
        const char* name;
        std::size_t open;
    } heads[] = {{"heads/LeePerrySmith.obj", 0},
                 {"heads/suzanne.obj", 42},
                 {"hair/ruby/ruby_head.obj", 945},
                 {"hair/ruby/head_max4.obj", 474}};
    for (const auto& head : heads) {
        const std::string path = shared_data(head.name);
        if (path.empty())
            continue;
        MeshReport report;
        read_obj(path, 1, &report);
        CAPTURE(path);
        CHECK(report.open_edges == head.open);
    }
}
