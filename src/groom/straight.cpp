#include "groom/attach.h"
#include "mane/error.h"
#include "mane/style.h"

#include <cmath>

namespace mane {
namespace {

// The axis of x, y, z that is most across `direction`.
Vec3d most_across(const Vec3d& direction) {
    const double x = std::fabs(direction.x), y = std::fabs(direction.y), z = std::fabs(direction.z);
    if (x <= y && x <= z)
        return {1, 0, 0};
    return z <= y ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
}

} // namespace

WispDesign design(const StraightWisp& wisp, const Mesh& wearer) {
    if (wisp.segments < 1)
        throw InputError("a straight wisp of 0 segments; expected at least 1");
    WispDesign d;
    d.triangle = wisp.triangle;
    d.barycentric = {1.0f / 3, 1.0f / 3, 1.0f / 3};
    d.strands = wisp.strands;
    d.skeleton = wisp.skeleton;
    d.envelope = wisp.envelope;

    const TriangleFrame frame = triangle_frame(wearer, d.triangle, d.barycentric);
    const Vec3d reach = frame.normal * double{wisp.depth}, first = frame.origin + reach;
    const Vec3d along = normalized(Vec3d(wisp.direction)) * double{wisp.length};
    d.position.push_back(Vec3(frame.origin - reach));
    for (std::uint32_t i = 0; i <= wisp.segments; ++i) {
        const double s = static_cast<double>(i) / wisp.segments;
        d.position.push_back(Vec3(first + along * s));
    }
    d.first_axis = Vec3(most_across(frame.normal));
    for (std::uint32_t i = 0; i < d.position.size(); ++i) {
        const float s = i < 2 ? 0 : static_cast<float>(i - 1) / static_cast<float>(wisp.segments);
        d.radius.insert(d.radius.end(), wisp.envelope.points, wisp.radius.at(s));
    }
    return d;
}

Body make_peg(float size) {
    const float a = size / std::sqrt(3.0f),
                h = size * std::sqrt(2.0f / 3.0f); // round the middle of a face; height
    Body peg;
    peg.name = "peg";
    peg.mesh.vertices = {
        {a, -h / 4, 0}, {-a / 2, -h / 4, size / 2}, {-a / 2, -h / 4, -size / 2}, {0, 3 * h / 4, 0}};
    peg.mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
    return peg;
}

} // namespace mane
