#include "check/judge.h"

#include <algorithm>

namespace mane::judge {
namespace {

constexpr double kWindow = 0.5;          // [s] in which a tip must follow its root a little
constexpr double kMovingRoot = 0.05;     // [m] path of a root in a window that asks for an answer
constexpr double kMovingHead = 0.25;     // [m] path of a root over the run, likewise
constexpr double kLeastFollowing = 1e-3; // [1] path of a tip over the path of its root
constexpr double kLeastSwing = 1e-4;     // [m] way of a tip as the head sees it
constexpr double kDetached = 1e-4;       // [m]

/// Hair thrown off, or frozen: roots ride the scalp, tips stay within reach of them, move when they
/// do, and not as if cast in one piece with the head.
class TipJudge final : public Judge {
  public:
    explicit TipJudge(const RunView& run) : run_(run), wisps_(run.groom.wisp_count()) {
        for (std::size_t w = 0; w < wisps_.size(); ++w)
            for (std::size_t s = run.groom.first_section[w] + 1; s < tip(w); ++s)
                wisps_[w].length += run.groom.rest_length[s];
    }

    void see(const FrameView& view) override {
        const BonePose head = head_pose(view);
        for (std::size_t w = 0; w < wisps_.size(); ++w) {
            Wisp& wisp = wisps_[w];
            const Vec3d root = scalp_point(view, w);
            const std::size_t outside = run_.groom.first_section[w] + 1;
            detached_.see(length(view.hair.section(outside).x - root), at(w, outside, view));
            const Vec3d end = view.hair.section(tip(w)).x;
            reach_.see(length(end - root) / wisp.length, at(w, tip(w), view));
            const Vec3d in_head =
                head.rotation.conjugate().rotate(end + view.frame.origin - head.position);
            follow(wisp, view, root + view.frame.origin, end + view.frame.origin, in_head, w);
        }
        if (first_ || view.time - window_start_ >= kWindow - 1e-6)
            start_window(view.time);
        first_ = false;
    }

    void report(std::vector<Criterion>& criteria) const override {
        const Question attached{"attached", "largest distance of x₁ from its place on the scalp",
                                "m", kDetached};
        criteria.push_back(answered(attached, detached_.value, detached_.where));
        const Question reach{"reach",
                             "largest distance of a tip from its root, in lengths of the wisp", "1",
                             run_.bounds.reach};
        criteria.push_back(answered(reach, reach_.value, reach_.where));
        const Question frozen{
            "tips_follow",
            "least way of a tip in half a second, relative to that of its moving root", "1",
            kLeastFollowing, Sense::at_least};
        criteria.push_back(stillest_.empty()
                               ? unanswered(frozen, "no root moves 50 mm in half a second")
                               : answered(frozen, -stillest_.value, stillest_.where));
        report_swing(criteria);
    }

  private:
    struct Wisp {
        double length = 0;                  // [m] from x₁ to the tip
        Vec3d root, tip;                    // [m] in the world, a frame ago
        double root_path = 0, tip_path = 0; // [m] in the window
        double whole_path = 0;              // [m] of the root, over the run
        Vec3d first_in_head;                // [m] the tip as the head saw it first
        Largest swing;                      // [m] from there
        Vec3d low, high;                    // [m] the tip's range in the head's axes
    };

    std::size_t tip(std::size_t w) const { return run_.groom.first_section[w + 1] - 1; }
    Offender at(std::size_t w, std::size_t s, const FrameView& view) const {
        return {static_cast<std::uint32_t>(w),
                static_cast<std::uint32_t>(s) - run_.groom.first_section[w],
                {},
                view.number};
    }

    BonePose head_pose(const FrameView& view) const {
        const auto& bones = view.poses[0];
        return run_.bodies[0].head_bone < bones.size() ? bones[run_.bodies[0].head_bone]
                                                       : BonePose{};
    }

    /// x₁ as the posed scalp carries it.
    Vec3d scalp_point(const FrameView& view, std::size_t w) const {
        const WispRoot& root = run_.groom.roots[w];
        const auto& corner = run_.bodies[0].mesh.triangles[root.triangle];
        const Vec3d a(view.vertices[0][corner[0]]), b(view.vertices[0][corner[1]]),
            c(view.vertices[0][corner[2]]);
        const Vec3d edge = normalized(b - a), normal = normalized(cross(b - a, c - a));
        const Vec3d on = a * double{root.barycentric.x} + b * double{root.barycentric.y} +
                         c * double{root.barycentric.z};
        return on + edge * double{root.outside.x} + normal * double{root.outside.y} +
               cross(edge, normal) * double{root.outside.z};
    }

    void follow(Wisp& wisp, const FrameView& view, const Vec3d& root, const Vec3d& end,
                const Vec3d& in_head, std::size_t w) {
        if (first_) {
            wisp.first_in_head = wisp.low = wisp.high = in_head;
        } else {
            const double step = length(root - wisp.root);
            wisp.root_path += step, wisp.whole_path += step;
            wisp.tip_path += length(end - wisp.tip);
            if (view.time - window_start_ >= kWindow - 1e-6 && wisp.root_path >= kMovingRoot)
                stillest_.see(-wisp.tip_path / wisp.root_path, at(w, tip(w), view));
        }
        wisp.low = {std::min(wisp.low.x, in_head.x), std::min(wisp.low.y, in_head.y),
                    std::min(wisp.low.z, in_head.z)};
        wisp.high = {std::max(wisp.high.x, in_head.x), std::max(wisp.high.y, in_head.y),
                     std::max(wisp.high.z, in_head.z)};
        wisp.swing.see(length(in_head - wisp.first_in_head), at(w, tip(w), view));
        wisp.root = root, wisp.tip = end;
    }

    void start_window(double time) {
        window_start_ = time;
        for (Wisp& wisp : wisps_)
            wisp.root_path = wisp.tip_path = 0;
    }

    void report_swing(std::vector<Criterion>& criteria) const {
        const Question swing{"tips_swing", "least way of a tip as the moving head sees it", "m",
                             kLeastSwing, Sense::at_least};
        Largest stiffest;
        for (const Wisp& wisp : wisps_)
            if (wisp.whole_path >= kMovingHead)
                stiffest.see(-wisp.swing.value, wisp.swing.where);
        criteria.push_back(stiffest.empty() ? unanswered(swing, "no root moves 0.25 m in all")
                                            : answered(swing, -stiffest.value, stiffest.where));
        double sum = 0;
        for (const Wisp& wisp : wisps_) {
            const Vec3d range = wisp.high - wisp.low;
            sum += std::max({range.x, range.y, range.z});
        }
        criteria.push_back(
            measured("tips_range", "widest range of a tip along one of the head's axes, on average",
                     "m", sum / static_cast<double>(wisps_.size()), "`tips_swing` is bounded"));
    }

    const RunView& run_;
    std::vector<Wisp> wisps_;
    bool first_ = true;
    double window_start_ = 0; // [s]
    Largest detached_, reach_, stillest_;
};

} // namespace

JudgePointer tip_judge(const RunView& run) {
    return std::make_unique<TipJudge>(run);
}

} // namespace mane::judge
