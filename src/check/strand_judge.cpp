#include "check/drawn_curve.h"
#include "check/judge.h"
#include "mane/strands.h"

#include <algorithm>
#include <cstdio>

namespace mane::judge {
namespace {

constexpr std::uint32_t kSamples = 4; // strand vertices per segment

/// Strand vertices deeper than `kDeep` in a body.
struct Deep {
    std::uint64_t count = 0;
    Largest deepest;

    void add(const Deep& other) {
        count += other.count;
        deepest.see(other.deepest.value, other.deepest.where);
    }
};

std::string in_millimetres(double depth) {
    char text[64];
    std::snprintf(text, sizeof text, "deepest %.1f mm", 1000 * depth);
    return text;
}

/// The strands of the scene, as many as are asked for.
StrandDesc looked_at(const RunView& run) {
    StrandDesc desc = run.strands;
    desc.count = run.options.strands;
    return desc;
}

/// What shows. M33: strand vertices from x₁ on that are deep inside a body. M17: strand vertices
/// stay inside the drawn envelope.
class StrandJudge final : public Judge {
  public:
    explicit StrandJudge(const RunView& run)
        : run_(run), shape_(run.groom, looked_at(run), run.simulation.seed, kSamples),
          positions_(shape_.vertex_count()), widths_(shape_.vertex_count()),
          deep_(run.groom.wisp_count()) {
        remember_parameters();
    }

    void see(const FrameView& view) override {
        shape_.pose(view.frame);
        shape_.fill(positions_, widths_);

        std::vector<Deep> deep(deep_.size()); // per wisp
        std::uint64_t vertices = 0;
        for (std::size_t strand = 0; strand < shape_.strand_count(); ++strand) {
            const std::uint32_t wisp = shape_.wisp(strand);
            const std::size_t begin = shape_.first_vertex(strand) + shape_.outside_vertex(),
                              end = shape_.first_vertex(strand + 1);
            for (std::size_t v = begin; v < end; ++v)
                see_vertex(view, wisp, v, deep[wisp]);
            vertices += end - begin;
        }
        vertices_ += vertices;
        add_frame(deep, vertices);
    }

    void report(std::vector<Criterion>& criteria) const override {
        const Question run{"strands_deep",
                           "share of strand vertices deeper than 2 mm in a body, over all frames",
                           "1", run_.bounds.strands_deep};
        const Question frame{"strands_deep_frame", "the same, in the worst frame", "1",
                             run_.bounds.strands_deep_frame};
        const Question drawn{"drawn_envelope",
                             "farthest strand vertex outside of the drawn envelope, in local radii",
                             "1", run_.bounds.drawn_envelope};
        if (vertices_ == 0) {
            for (const Question& q : {run, frame, drawn})
                criteria.push_back(unanswered(q, "there are no strands"));
            return;
        }
        Deep all;
        for (const Deep& wisp : deep_)
            all.count += wisp.count;
        const double share = static_cast<double>(all.count) / static_cast<double>(vertices_);
        criteria.push_back(answer(run, share, worst_wisp(deep_)));
        criteria.push_back(answer(frame, worst_share_, worst_frame_));
        criteria.push_back(outside_.value > 0 ? answered(drawn, outside_.value, outside_.where)
                                              : answered(drawn, 0, {}));
    }

  private:
    /// Where a strand's vertices are along it is the same in every frame.
    void remember_parameters() {
        for (std::size_t strand = 0; strand < shape_.strand_count(); ++strand) {
            const std::size_t count = shape_.first_vertex(strand + 1) - shape_.first_vertex(strand);
            for (std::uint32_t v = 0; v < count; ++v)
                parameter_.push_back(shape_.parameter(strand, v));
        }
    }

    void see_vertex(const FrameView& view, std::uint32_t wisp, std::size_t v, Deep& deep) {
        const Vec3d p(positions_[v]);
        const Offender at{wisp, static_cast<std::uint32_t>(parameter_[v]), {}, view.number};
        for (const Solid& solid : view.solids)
            if (solid.contains(p) && solid.depth(p, kDeep) > kDeep) {
                ++deep.count;
                deep.deepest.see(solid.depth(p), at);
                break;
            }
        section_.place(run_.groom, view.hair, wisp, double{parameter_[v]});
        outside_.see(section_.outside(p), at);
    }

    void add_frame(const std::vector<Deep>& deep, std::uint64_t vertices) {
        std::uint64_t count = 0;
        for (std::size_t w = 0; w < deep.size(); ++w) {
            deep_[w].add(deep[w]);
            count += deep[w].count;
        }
        const double share =
            vertices > 0 ? static_cast<double>(count) / static_cast<double>(vertices) : 0;
        if (share > worst_share_) {
            worst_share_ = share;
            worst_frame_ = worst_wisp(deep);
        }
    }

    /// The wisp with the most deep vertices.
    static Deep worst_wisp(const std::vector<Deep>& deep) {
        return *std::ranges::max_element(deep, {}, &Deep::count);
    }

    static Criterion answer(const Question& question, double share, const Deep& worst) {
        if (worst.count == 0)
            return answered(question, share, {});
        return answered(question, share, worst.deepest.where, in_millimetres(worst.deepest.value));
    }

    const RunView& run_;
    StrandShape shape_;
    std::vector<Vec3> positions_;
    std::vector<float> widths_;
    std::vector<float> parameter_; // per vertex of all strands
    DrawnSection section_;
    std::uint64_t vertices_ = 0; // seen, from x₁ on
    std::vector<Deep> deep_;     // per wisp, over the run
    double worst_share_ = 0;
    Deep worst_frame_; // its worst wisp
    Largest outside_;
};

} // namespace

JudgePointer strand_judge(const RunView& run) {
    return std::make_unique<StrandJudge>(run);
}

} // namespace mane::judge
