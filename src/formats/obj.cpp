#include "mane/error.h"
#include "mane/import.h"

#include "formats/text.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace mane {
namespace {

// One OBJ file being read. Only `v` and `f` matter: normals and textures would be recomputed
// anyway.
class ObjReader {
  public:
    ObjReader(const std::string& path, double unit) : path_(path), unit_(unit) {}

    Mesh read(std::size_t& dropped) {
        const std::string text = read_text(path_);
        LineReader lines(text);
        Line line;
        while (lines.next(line))
            read_line(line);
        if (mesh_.vertices.empty())
            throw InputError(path_ + ": no vertices in " + std::to_string(lines.number()) +
                             " lines; expected `v x y z`");
        if (mesh_.triangles.empty())
            throw InputError(path_ + ": no polygons in " + std::to_string(lines.number()) +
                             " lines; expected `f a b c`; is the file truncated?");
        join_seams();
        dropped = dropped_;
        return std::move(mesh_);
    }

  private:
    void read_line(const Line& line) {
        std::string_view rest = line.text.substr(0, line.text.find('#'));
        const std::string_view keyword = take_word(rest);
        if (keyword == "v")
            read_vertex(rest, line.number);
        if (keyword == "f")
            read_polygon(rest, line.number);
    }

    void read_vertex(std::string_view rest, std::size_t line) {
        double c[3];
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = take_word(rest);
            if (word.empty())
                fail_at(path_, line,
                        "vertex with " + std::to_string(axis) + " coordinates, expected 3");
            if (!parse_number(word, c[axis]) || !std::isfinite(c[axis]))
                fail_at(path_, line,
                        "vertex coordinate \"" + std::string(word) +
                            "\", expected a finite number");
        }
        mesh_.vertices.push_back(Vec3(Vec3d(c[0], c[1], c[2]) * unit_));
    }

    void read_polygon(std::string_view rest, std::size_t line) {
        polygon_.clear();
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest))
            polygon_.push_back(vertex_index(word, line));
        if (polygon_.size() < 3)
            fail_at(path_, line,
                    "polygon with " + std::to_string(polygon_.size()) +
                        " corners, expected at least 3");
        for (std::size_t c = 2; c < polygon_.size(); ++c)
            mesh_.triangles.push_back({polygon_[0], polygon_[c - 1], polygon_[c]});
    }

    // "7", "7/1", "7//3", "7/1/3"; from 1, or from −1 backwards.
    std::uint32_t vertex_index(std::string_view corner, std::size_t line) const {
        const std::string_view word = corner.substr(0, corner.find('/'));
        const auto count = static_cast<long long>(mesh_.vertices.size());
        long long index = 0;
        if (!parse_number(word, index))
            fail_at(path_, line,
                    "polygon corner \"" + std::string(corner) + "\", expected a vertex's number");
        const long long found = index < 0 ? count + index : index - 1;
        if (index == 0 || found < 0 || found >= count)
            fail_at(path_, line,
                    "polygon corner " + std::to_string(index) + ", but there are " +
                        std::to_string(count) + " vertices so far");
        return static_cast<std::uint32_t>(found);
    }

    // Exporters repeat vertices along seams of textures and normals: triangles take the first
    // vertex of each position, or the surface would be open along every seam.
    void join_seams() {
        std::vector<std::uint32_t> order(mesh_.vertices.size()), first(order.size());
        std::iota(order.begin(), order.end(), 0u);
        const auto key = [&](std::uint32_t v) {
            const Vec3& p = mesh_.vertices[v];
            return std::tuple(p.x, p.y, p.z);
        };
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        for (std::size_t i = 0; i < order.size(); ++i) {
            const bool repeated = i > 0 && key(order[i]) == key(order[i - 1]);
            first[order[i]] = repeated ? first[order[i - 1]] : order[i];
        }
        for (auto& t : mesh_.triangles)
            t = {first[t[0]], first[t[1]], first[t[2]]};
        dropped_ += std::erase_if(mesh_.triangles, [](const auto& t) {
            return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
        });
    }

    const std::string& path_;
    double unit_;
    Mesh mesh_;
    std::vector<std::uint32_t> polygon_;
    std::size_t dropped_ = 0;
};

} // namespace

Mesh read_obj(const std::string& path, double unit, MeshReport* report) {
    std::size_t dropped = 0;
    Mesh mesh = ObjReader(path, unit).read(dropped);
    MeshReport found = inspect_mesh(mesh);
    if (found.flat_triangles == mesh.triangles.size())
        throw InputError(path + ": all " + std::to_string(mesh.triangles.size() + dropped) +
                         " triangles are without area; expected a surface");
    found.dropped_triangles = dropped;
    if (report)
        *report = found;
    return mesh;
}

} // namespace mane
