#include "groom/sections.h"

#include "base/functions.h"
#include "groom/grow.h"
#include "groom/shape.h"

#include <algorithm>
#include <cmath>

namespace mane {
namespace {

constexpr double kDepth = 0.008; // [m] of x₀ under the scalp
constexpr double kAir = 0.002;   // [m] left between envelope and skin
constexpr double kLeastShare =
    0.35; // of a radius that stays, so that its spring can carry its point (M44)

// `segments` + 1 points along the line, at equal ways.
std::vector<Vec3d> resampled(std::span<const Vec3d> line, std::uint32_t segments) {
    std::vector<double> way(line.size());
    for (std::size_t i = 1; i < line.size(); ++i)
        way[i] = way[i - 1] + length(line[i] - line[i - 1]);
    std::vector<Vec3d> points;
    std::size_t next = 1;
    for (std::uint32_t k = 0; k < segments; ++k) {
        const double wanted = way.back() * k / segments;
        while (way[next] <= wanted)
            ++next;
        const double f = (wanted - way[next - 1]) / (way[next] - way[next - 1]);
        points.push_back(line[next - 1] * (1 - f) + line[next] * f);
    }
    points.push_back(line.back());
    return points;
}

// x₀ lies straight behind the wisp's first direction, so that the root's joint is hardly bent.
Vec3d inner_point(const ScalpPoint& root, std::span<const Vec3d> line) {
    const Vec3d direction = normalized(line[1] - line[0]);
    const double height = dot(line[0] - root.position, root.normal);
    return line[0] - direction * ((height + kDepth) / std::max(0.3, dot(direction, root.normal)));
}

// Of an ellipse with half axes `width` and `depth`, at the angle whose cosine and sine are given.
double ellipse_radius(double width, double depth, double cosine, double sine) {
    return width * depth / std::sqrt(depth * depth * cosine * cosine + width * width * sine * sine);
}

// The envelope's surface (M14a), at some places of each segment.
class Surface {
  public:
    Surface(const Shape& shape, std::vector<double>& radius, std::uint32_t points)
        : shape_(shape), radius_(radius), points_(points) {}

    // Shortens the radii that bound a place inside the body, a little at a time so that all share;
    // true if any was.
    bool shrink(const Solid& body, std::span<const double> least) {
        bool any = false;
        for (std::size_t i = 1; i + 1 < shape_.sections(); ++i)
            for (std::size_t k = 0; k < points_; ++k)
                for (int along = 0; along < kPlacesAlong; ++along)
                    for (int around = 0; around < kPlacesAround; ++around)
                        if (body.clearance(place(i, k, share(along, kPlacesAlong),
                                                 share(around, kPlacesAround)))
                                .distance < kAir)
                            any |= shrink_bounds(i, k, along > 0, around > 0, least);
        return any;
    }

  private:
    static constexpr int kPlacesAlong = 3, kPlacesAround = 2;
    static constexpr double kShrink = 0.94;
    static double share(int i, int of) { return static_cast<double>(i) / of; }

    Vec3d on_section(std::size_t i, std::size_t k, double around) const {
        const double c = cosine(kPi / 2 * around), s = sine(kPi / 2 * around);
        return reach(i, k) * c + reach(i, (k + 1) % points_) * s + shape_.position[i];
    }
    Vec3d reach(std::size_t i, std::size_t k) const {
        const double angle = 2 * kPi * static_cast<double>(k) / static_cast<double>(points_);
        return (shape_.u[i] * cosine(angle) + shape_.v[i] * sine(angle)) * radius_[i * points_ + k];
    }
    Vec3d place(std::size_t i, std::size_t k, double along, double around) const {
        return on_section(i, k, around) * (1 - along) + on_section(i + 1, k, around) * along;
    }
    bool shrink_bounds(std::size_t i, std::size_t k, bool next_section, bool next_line,
                       std::span<const double> least) {
        bool any = false;
        for (std::size_t section = i; section <= i + (next_section ? 1 : 0); ++section)
            for (std::size_t line : {k, next_line ? (k + 1) % points_ : k}) {
                double& r = radius_[section * points_ + line];
                const double floor = least[section * points_ + line];
                any |= r > floor;
                r = std::max(floor, r * kShrink);
            }
        return any;
    }

    const Shape& shape_;
    std::vector<double>& radius_;
    std::uint32_t points_;
};

std::vector<double> section_radii(const StyleDesc& style, const Shape& shape, std::uint32_t points,
                                  const Solid& body) {
    const auto segments = static_cast<double>(shape.sections() - 2);
    std::vector<double> radius, least;
    for (std::size_t i = 0; i < shape.sections(); ++i) {
        const double width = wisp_radius(style, i < 2 ? 0 : static_cast<double>(i - 1) / segments);
        for (std::uint32_t k = 0; k < points; ++k) {
            const double angle = 2 * kPi * k / points;
            radius.push_back(
                ellipse_radius(width, width * style.thickness, cosine(angle), sine(angle)));
            least.push_back(kLeastShare * radius.back());
        }
    }
    Surface surface(shape, radius, points);
    while (surface.shrink(body, least)) {
    }
    return radius;
}

} // namespace

WispDesign cut_sections(const StyleDesc& style, const EnvelopeDesc& envelope,
                        const ScalpPoint& root, std::span<const Vec3d> line, std::uint32_t segments,
                        const Solid& body) {
    std::vector<Vec3d> x = resampled(line, segments);
    x.insert(x.begin(), inner_point(root, line));
    const Shape shape = make_shape(x, cross(root.normal, line[1] - line[0]));
    WispDesign wisp;
    wisp.triangle = root.triangle;
    wisp.barycentric = Vec3(root.barycentric);
    wisp.first_axis = Vec3(shape.u[0]);
    wisp.envelope = envelope;
    for (const Vec3d& p : x)
        wisp.position.push_back(Vec3(p));
    for (double r : section_radii(style, shape, envelope.points, body))
        wisp.radius.push_back(static_cast<float>(r));
    return wisp;
}

} // namespace mane
