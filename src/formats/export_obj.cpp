#include "formats/export_formats.h"

#include <charconv>

namespace mane {
namespace {

// Text collected and written in pieces: a million strands are gigabytes.
class Lines {
  public:
    explicit Lines(WholeFile& file) : file_(file) {}

    Lines& text(std::string_view t) {
        buffer_ += t;
        return *this;
    }
    template <typename T>
    Lines& number(T x) { // the shortest text that reads back as the same number
        char digits[40];
        const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
        buffer_.append(digits, end);
        return *this;
    }
    void end_line() {
        buffer_ += '\n';
        if (buffer_.size() > kPiece)
            flush();
    }
    void flush() {
        file_.write(buffer_);
        buffer_.clear();
    }

  private:
    static constexpr std::size_t kPiece = 1 << 20;
    WholeFile& file_;
    std::string buffer_;
};

void write_vertices(std::span<const Vec3> vertices, const Vec3d& origin, Lines& lines) {
    lines.text("# mane; metres, Y up").end_line();
    for (const Vec3& v : vertices) {
        const Vec3 p(Vec3d(v) + origin);
        lines.text("v ").number(p.x).text(" ").number(p.y).text(" ").number(p.z).end_line();
    }
}

} // namespace

void write_obj(const Curves& curves, const Vec3d& origin, WholeFile& file) {
    Lines lines(file);
    write_vertices(curves.position, origin, lines);
    for (std::size_t s = 0; s + 1 < curves.first_vertex.size(); ++s) {
        lines.text("l");
        for (std::uint32_t v = curves.first_vertex[s]; v < curves.first_vertex[s + 1]; ++v)
            lines.text(" ").number(v + 1);
        lines.end_line();
    }
    lines.flush();
}

void write_obj(const Mesh& mesh, const Vec3d& origin, WholeFile& file) {
    Lines lines(file);
    write_vertices(mesh.vertices, origin, lines);
    for (const auto& [a, b, c] : mesh.triangles)
        lines.text("f ").number(a + 1).text(" ").number(b + 1).text(" ").number(c + 1).end_line();
    lines.flush();
}

} // namespace mane
