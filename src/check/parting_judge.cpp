#include "check/judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace mane::judge {
namespace {

constexpr double kLasting = 0.5; // [s]

using Pair = std::array<std::uint32_t, 2>; // of wisps, the lower number first

/// A direction in a triangle's own frame (`WispRoot`), in the axes of the mesh.
Vec3d of_triangle(const Mesh& mesh, std::uint32_t triangle, const Vec3& direction) {
    const auto& corner = mesh.triangles[triangle];
    const Vec3d a(mesh.vertices[corner[0]]), b(mesh.vertices[corner[1]]),
        c(mesh.vertices[corner[2]]);
    const Vec3d edge = normalized(b - a), normal = normalized(cross(b - a, c - a));
    return edge * double{direction.x} + normal * double{direction.y} +
           cross(edge, normal) * double{direction.z};
}

Frame designed(const Groom& groom, const Mesh& mesh) {
    Frame frame;
    frame.position = groom.position;
    frame.radius = groom.radius;
    for (const WispRoot& root : groom.roots)
        frame.first_axis.emplace_back(of_triangle(mesh, root.triangle, root.first_axis));
    return frame;
}

/// M41: partings. Wisps whose outer halves touch in the design are neighbours; where their outer
/// halves intersect nowhere, there is a parting between them. Near the roots all wisps are packed
/// and never part.
class PartingJudge final : public Judge {
  public:
    explicit PartingJudge(const RunView& run) : run_(run) {
        const Frame design = designed(run.groom, run.bodies[0].mesh);
        const HairGeometry hair(run.groom, design);
        neighbours_ = touching(Overlaps(run.groom, hair));
    }

    void see(const FrameView& view) override {
        const std::vector<Pair> touch = touching(view.overlaps);
        std::vector<bool> parted;
        for (const Pair& pair : neighbours_)
            parted.push_back(!std::ranges::binary_search(touch, pair));
        parted_.push_back(std::move(parted));
    }

    void report(std::vector<Criterion>& criteria) const override {
        std::size_t parted = 0, followed = 0, lasting = 0;
        const std::size_t later = frames_later();
        for (std::size_t f = 0; f < parted_.size(); ++f)
            for (std::size_t i = 0; i < neighbours_.size(); ++i) {
                if (!parted_[f][i])
                    continue;
                ++parted;
                if (later == 0 || f + later >= parted_.size())
                    continue;
                ++followed;
                lasting += parted_[f + later][i];
            }
        const char* meaning = "share of neighbouring wisps with a parting between them, on average";
        const char* last = "share of partings that are there half a second later";
        criteria.push_back(
            neighbours_.empty()
                ? unanswered({"partings", meaning, "1", 0}, "no wisps are neighbours")
                : measured("partings", meaning, "1", share(parted, all()), "a matter of style"));
        criteria.push_back(
            followed == 0
                ? unanswered({"partings_last", last, "1", 0}, "none is there for long enough")
                : measured("partings_last", last, "1", share(lasting, followed),
                           "wisps off, isotropic and as in the paper compare by it"));
    }

  private:
    std::size_t all() const { return parted_.size() * neighbours_.size(); }
    static double share(std::size_t part, std::size_t whole) {
        return static_cast<double>(part) / static_cast<double>(whole);
    }
    std::size_t frames_later() const {
        return run_.frame_time() > 0
                   ? static_cast<std::size_t>(std::llround(kLasting / run_.frame_time()))
                   : 0;
    }

    bool outer(std::uint32_t wisp, std::uint32_t section) const {
        return 2 * (section - run_.groom.first_section[wisp]) >= run_.groom.sections(wisp);
    }

    /// Wisps whose outer halves intersect, in order, each once.
    std::vector<Pair> touching(const Overlaps& overlaps) const {
        std::vector<Pair> pairs;
        for (const auto& [i, j] : overlaps.pairs()) {
            const std::uint32_t s = overlaps.segments()[i], t = overlaps.segments()[j];
            const std::uint32_t a = wisp_of(run_.groom, s), b = wisp_of(run_.groom, t);
            if (a != b && outer(a, s) && outer(b, t))
                pairs.push_back({std::min(a, b), std::max(a, b)});
        }
        std::ranges::sort(pairs);
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        return pairs;
    }

    const RunView& run_;
    std::vector<Pair> neighbours_;
    std::vector<std::vector<bool>> parted_; // per frame and pair of neighbours
};

} // namespace

JudgePointer parting_judge(const RunView& run) {
    return std::make_unique<PartingJudge>(run);
}

} // namespace mane::judge
