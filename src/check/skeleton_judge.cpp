#include "check/judge.h"

#include <algorithm>

namespace mane::judge {
namespace {

/// M33 for the skeletons: no simulated point inside a body in any frame, and no segment's axis that
/// stays through one.
class SkeletonJudge final : public Judge {
  public:
    explicit SkeletonJudge(const RunView& run)
        : run_(run), through_since_(run.groom.section_count(), -1) {}

    void see(const FrameView& view) override {
        for (std::size_t w = 0; w < run_.groom.wisp_count(); ++w) {
            const std::size_t first = run_.groom.first_section[w],
                              tip = run_.groom.first_section[w + 1] - 1;
            for (std::size_t s = first + 2; s <= tip; ++s)
                see_point(view, s);
            for (std::size_t s = first + 1; s < tip; ++s)
                see_axis(view, s);
        }
    }

    void report(std::vector<Criterion>& criteria) const override {
        const Question inside{"skeleton_inside", "skeleton points inside a body, over all frames",
                              "1", 0};
        std::optional<Offender> worst;
        if (inside_ > 0)
            worst = deepest_.where;
        criteria.push_back(answered(inside, static_cast<double>(inside_), worst));
        Criterion depth = measured("skeleton_depth", "how deep the deepest of them is", "m",
                                   inside_ > 0 ? deepest_.value : 0, "no point may be inside");
        depth.worst = worst;
        criteria.push_back(depth);

        const Question through{"axis_through", "longest time that a segment's axis stays in a body",
                               "s", run_.bounds.axis_through};
        if (longest_.empty())
            criteria.push_back(answered(through, 0, {}));
        else
            criteria.push_back(answered(through, longest_.value, longest_.where));
    }

  private:
    void see_point(const FrameView& view, std::size_t s) {
        const Vec3d& p = view.hair.section(s).x;
        for (const Solid& solid : view.solids)
            if (solid.contains(p)) {
                ++inside_;
                deepest_.see(solid.depth(p), offender(run_.groom, s, view.number));
                return;
            }
    }

    void see_axis(const FrameView& view, std::size_t s) {
        const Vec3d &a = view.hair.section(s).x, &b = view.hair.section(s + 1).x;
        const bool through =
            std::ranges::any_of(view.solids, [&](const Solid& solid) { return solid.meets(a, b); });
        double& since = through_since_[s];
        if (!through) {
            since = -1;
            return;
        }
        if (since < 0)
            since = view.time - run_.time.front();
        longest_.see(view.time - run_.time.front() - since, offender(run_.groom, s, view.number));
    }

    const RunView& run_;
    std::uint64_t inside_ = 0;
    Largest deepest_, longest_;
    std::vector<double> through_since_; // [s] from the first frame on, per segment; −1: it is not
};

} // namespace

JudgePointer skeleton_judge(const RunView& run) {
    return std::make_unique<SkeletonJudge>(run);
}

} // namespace mane::judge
