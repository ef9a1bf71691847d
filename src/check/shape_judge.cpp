#include "check/judge.h"

namespace mane::judge {
namespace {

/// Stretch of the skeletons, and the area that the envelopes keep.
class ShapeJudge final : public Judge {
  public:
    explicit ShapeJudge(const RunView& run) : run_(run) {
        for_simulated([&](std::size_t s) {
            design_.push_back(section_area(run.groom.radius, s, run.groom.envelope_points));
            design_sum_ += design_.back();
        });
    }

    void see(const FrameView& view) override {
        see_stretch(view);
        see_area(view);
    }

    void report(std::vector<Criterion>& criteria) const override {
        const Question stretch{"stretch", "longest that a segment gets, over its rest length", "1",
                               run_.bounds.stretch};
        if (run_.strands.waves > 0 && run_.strands.wave_amplitude > 0) {
            Criterion c =
                unanswered(stretch, "bounds straight styles only; these strands are wavy");
            c.value = stretch_.value, c.worst = stretch_.where;
            criteria.push_back(c);
        } else {
            criteria.push_back(answered(stretch, stretch_.value, stretch_.where));
        }
        const Question area{"area", "mean area of all sections of a frame, relative to the design",
                            "1", run_.bounds.area, Sense::at_least};
        criteria.push_back(answered(area, -loss_.value, flattest_.where));
        criteria.push_back(measured("area_mean", "the same, on average over the frames", "1",
                                    area_sum_ / static_cast<double>(frames_), "`area` is bounded"));
    }

  private:
    /// Sections whose radii are free.
    template <typename Visit> void for_simulated(const Visit& visit) const {
        for (std::size_t w = 0; w < run_.groom.wisp_count(); ++w)
            for (std::size_t s = run_.groom.first_section[w] + 2;
                 s < run_.groom.first_section[w + 1]; ++s)
                visit(s);
    }

    void see_stretch(const FrameView& view) {
        for_simulated([&](std::size_t s) { // the segment that ends there
            const double now = length(view.hair.section(s).x - view.hair.section(s - 1).x);
            const double rest = run_.groom.rest_length[s - 1];
            stretch_.see(now / rest - 1, offender(run_.groom, s - 1, view.number));
        });
    }

    void see_area(const FrameView& view) {
        double sum = 0;
        Largest flattest;
        std::size_t i = 0;
        for_simulated([&](std::size_t s) {
            const double area = section_area(view.frame.radius, s, run_.groom.envelope_points);
            sum += area;
            flattest.see(-area / design_[i++], offender(run_.groom, s, view.number));
        });
        area_sum_ += sum / design_sum_;
        ++frames_;
        if (loss_.see(-sum / design_sum_, {.frame = view.number}))
            flattest_ = flattest;
    }

    const RunView& run_;
    std::vector<double> design_; // [m²] area of the simulated sections
    double design_sum_ = 0;
    double area_sum_ = 0; // [1] of the frames' relative areas
    std::size_t frames_ = 0;
    Largest stretch_;
    Largest loss_;     // minus the relative area of a frame
    Largest flattest_; // the section that lost most in the worst frame
};

} // namespace

JudgePointer shape_judge(const RunView& run) {
    return std::make_unique<ShapeJudge>(run);
}

} // namespace mane::judge
