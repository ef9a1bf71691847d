#include "check/judge.h"

#include <cmath>
#include <deque>
#include <numbers>

namespace mane::judge {
namespace {

constexpr double kSlow = 3, kStill = 6; // [s] after the motion stopped
constexpr double kJitter = 10;          // [Hz] motion from here on is jitter
constexpr double kCutOff = 8.5;         // [Hz] middle of the filter's fall, which ends at 10 Hz
constexpr double kHalfWidth = 0.5;      // [s] of the filter

/// The slope of a low-passed curve as a weighted sum of its samples: the derivative of a windowed
/// sinc.
///
/// What the stored velocity has beyond this slope is motion above the cut-off. Velocities alone
/// would not tell: at 24 frames a second 100 Hz look like 4 Hz. Their share in the positions is a
/// hundredfold smaller, so compared with the slope of the positions they show at any frequency.
class SmoothSlope {
  public:
    explicit SmoothSlope(double frame_time) {
        reach_ = static_cast<int>(std::floor(kHalfWidth / frame_time));
        double slope = 0;
        for (int j = 1; j <= reach_; ++j) {
            const double t = j * frame_time, step = 1e-4 * frame_time;
            weights_.push_back((low_pass(t - step) - low_pass(t + step)) / (2 * step));
            slope += 2 * weights_.back() * t;
        }
        for (double& w : weights_)
            w /= slope; // exact for steady motion
    }

    int reach() const { return reach_; }
    /// `values(j)`: the curve j frames from the one in question.
    template <typename Values> auto operator()(const Values& values) const {
        auto sum = (values(1) - values(-1)) * weights_[0];
        for (int j = 2; j <= reach_; ++j)
            sum += (values(j) - values(-j)) * weights_[static_cast<std::size_t>(j) - 1];
        return sum;
    }

  private:
    static double low_pass(double t) {
        const double x = 2 * kCutOff * t, pi = std::numbers::pi;
        const double window = 0.5 + 0.5 * std::cos(pi * t / kHalfWidth);
        return std::sin(pi * x) / (pi * x) * window;
    }

    int reach_ = 0;
    std::vector<double> weights_; // of the frames after; those before have the opposite ones
};

/// Hair at rest once the motion has stopped: slow, then still, and never trembling.
class RestJudge final : public Judge {
  public:
    explicit RestJudge(const RunView& run) : run_(run) {
        if (judged() && run.frame_time() * kJitter * 2 <= 1)
            slope_.emplace(run.frame_time());
    }

    void see(const FrameView& view) override {
        if (!judged())
            return;
        const double since = view.time - *run_.stop;
        if (since >= kSlow - kHalfWidth - 1e-6)
            see_jitter(view);
        if (since >= kSlow - 1e-6)
            see_speed(view, slow_);
        if (since >= kStill - 1e-6)
            see_speed(view, still_);
    }

    void report(std::vector<Criterion>& criteria) const override {
        const Question slow{"rest_speed", "fastest point from 3 s after the motion stopped", "m/s",
                            run_.bounds.rest_speed};
        const Question still{"still_speed", "fastest point from 6 s after the motion stopped",
                             "m/s", run_.bounds.still_speed};
        const Question jitter{"rest_jitter", "motion above 10 Hz from 3 s after the motion stopped",
                              "m/s", run_.bounds.rest_jitter};
        answer(slow, slow_, "the file ends before", criteria);
        answer(still, still_, "the file ends before", criteria);
        answer(jitter, jitter_,
               slope_ ? "the file ends within half a second of it"
                      : "the frames are too far apart to show 10 Hz",
               criteria);
    }

  private:
    bool judged() const { return run_.stop && run_.simulation.air.gusts <= 0; }

    void answer(const Question& question, const Largest& found, const char* otherwise,
                std::vector<Criterion>& criteria) const {
        if (!run_.stop)
            criteria.push_back(unanswered(question, "the motion does not stop inside the file"));
        else if (!judged())
            criteria.push_back(unanswered(question, "gusts keep the hair moving"));
        else if (found.empty())
            criteria.push_back(unanswered(question, otherwise));
        else
            criteria.push_back(answered(question, found.value, found.where));
    }

    template <typename Visit> void for_simulated(const Visit& visit) const {
        for (std::size_t w = 0; w < run_.groom.wisp_count(); ++w)
            for (std::size_t s = run_.groom.first_section[w] + 2;
                 s < run_.groom.first_section[w + 1]; ++s)
                visit(s);
    }

    void see_speed(const FrameView& view, Largest& largest) const {
        for_simulated([&](std::size_t s) {
            Offender at = offender(run_.groom, s, view.number);
            const Vec3d v(view.frame.velocity[s]);
            largest.see(length(v), at);
            for (std::uint32_t k = 0; k < view.hair.points(); ++k) {
                at.point = k;
                const double rate = view.frame.radius_rate[s * view.hair.points() + k];
                largest.see(length(v + view.hair.half_line(s, k) * rate), at);
            }
        });
    }

    /// Judges the frame in the middle of the last ones.
    void see_jitter(const FrameView& view) {
        if (!slope_)
            return;
        const int middle = slope_->reach();
        const std::size_t width = 2 * static_cast<std::size_t>(middle) + 1;
        frames_.push_back(view.frame);
        if (frames_.size() > width)
            frames_.pop_front();
        if (frames_.size() < width)
            return;
        const std::uint32_t number = view.number - static_cast<std::uint32_t>(middle);
        const auto frame = [&](int j) -> const Frame& { return frames_.begin()[middle + j]; };
        for_simulated([&](std::size_t s) {
            const Vec3d smooth =
                (*slope_)([&](int j) { return Vec3d(frame(j).position[s]) + frame(j).origin; });
            Offender at = offender(run_.groom, s, number);
            jitter_.see(length(Vec3d(frame(0).velocity[s]) - smooth), at);
            for (std::uint32_t k = 0; k < view.hair.points(); ++k) {
                const std::size_t i = s * view.hair.points() + k;
                const double rate = (*slope_)([&](int j) { return double{frame(j).radius[i]}; });
                at.point = k;
                jitter_.see(std::fabs(double{frame(0).radius_rate[i]} - rate), at);
            }
        });
    }

    const RunView& run_;
    std::optional<SmoothSlope> slope_;
    std::deque<Frame> frames_; // the last ones
    Largest slow_, still_, jitter_;
};

} // namespace

JudgePointer rest_judge(const RunView& run) {
    return std::make_unique<RestJudge>(run);
}

} // namespace mane::judge
