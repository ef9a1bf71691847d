#include "formats/export_formats.h"
#include "mane/error.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

namespace mane {
namespace {

static_assert(std::endian::native == std::endian::little,
              "HAIR and PLY files are written as they are in memory");

// The file's first 128 bytes, as cemyuksel.com/research/hairmodels defines them.
struct Header {
    char signature[4] = {'H', 'A', 'I', 'R'};
    std::uint32_t strands = 0;
    std::uint32_t points = 0;
    std::uint32_t arrays = 0;
    std::uint32_t default_segments = 0;
    float default_thickness = 0;
    float default_transparency = 0;
    float default_colour[3] = {0.36f, 0.22f, 0.13f};
    char information[88] = {};
};
static_assert(sizeof(Header) == 128);

enum Arrays : std::uint32_t { kSegments = 1, kPoints = 2, kThickness = 4 };

std::vector<std::uint16_t> segments_of(const Curves& curves) {
    std::vector<std::uint16_t> segments;
    for (std::size_t s = 0; s + 1 < curves.first_vertex.size(); ++s) {
        const std::uint32_t count = curves.first_vertex[s + 1] - curves.first_vertex[s] - 1;
        if (count > std::numeric_limits<std::uint16_t>::max())
            throw InputError("a HAIR file holds at most 65535 segments a strand, found " +
                             std::to_string(count) + " in strand " + std::to_string(s));
        segments.push_back(static_cast<std::uint16_t>(count));
    }
    return segments;
}

} // namespace

void write_hair(const Curves& curves, const Vec3d& origin, WholeFile& file) {
    const std::vector<std::uint16_t> segments = segments_of(curves);
    const bool alike =
        std::adjacent_find(segments.begin(), segments.end(), std::not_equal_to{}) == segments.end();

    Header header;
    header.strands = static_cast<std::uint32_t>(segments.size());
    header.points = static_cast<std::uint32_t>(curves.position.size());
    header.arrays = kPoints | kThickness | (alike ? 0u : kSegments);
    header.default_segments = segments.empty() ? 0 : segments.front();
    header.default_thickness = curves.width.empty() ? 0 : curves.width.front();
    std::strncpy(header.information, "mane; metres, Y up; thickness is the diameter",
                 sizeof header.information - 1);
    file.write(&header, sizeof header);

    if (!alike)
        file.write_numbers<std::uint16_t>(segments);
    std::vector<Vec3> points;
    points.reserve(curves.position.size());
    for (const Vec3& p : curves.position)
        points.emplace_back(Vec3d(p) + origin);
    file.write_numbers<Vec3>(points);
    file.write_numbers<float>(curves.width);
}

} // namespace mane
