#include "check/judge.h"

#include <algorithm>
#include <cmath>

namespace mane::judge {
namespace {

constexpr double kWindow = 1;        // [s] over which a swing passes its largest speed
constexpr double kQuietSpeed = 0.02; // [m/s] slower than this on average, hair may creep
constexpr double kBound = 1;
constexpr double kDecayed = 0.01;

/// Kinetic energy: never more than the hair could have taken from the motion, and less from second
/// to second once the motion has stopped.
class EnergyJudge final : public Judge {
  public:
    explicit EnergyJudge(const RunView& run) : run_(run) {
        for (std::size_t w = 0; w < run.groom.wisp_count(); ++w)
            add_wisp(w);
    }

    void see(const FrameView& view) override {
        see_motion(view);
        double energy = 0;
        Largest fastest;
        for (std::size_t w = 0; w < run_.groom.wisp_count(); ++w)
            for (std::size_t s = run_.groom.first_section[w] + 2;
                 s < run_.groom.first_section[w + 1]; ++s) {
                energy += kinetic_energy(run_.groom, view.frame, view.hair, s);
                fastest.see(length(view.frame.velocity[s]), offender(run_.groom, s, view.number));
            }
        if (largest_.see(energy, {.frame = view.number}))
            fastest_ = fastest.where;
        if (run_.stop && view.time >= *run_.stop)
            see_after_stop(view, energy, fastest.where);
    }

    void report(std::vector<Criterion>& criteria) const override {
        const Question bounded{
            "energy", "largest kinetic energy, relative to what motion, fall and wind can give",
            "1", kBound};
        criteria.push_back(answered(bounded, largest_.value / available_energy(), fastest_));
        const Question falls{
            "energy_falls",
            "largest rise of kinetic energy from one second to the next after the motion stopped",
            "1", kBound};
        if (!run_.stop)
            criteria.push_back(unanswered(falls, "the motion does not stop inside the file"));
        else if (run_.simulation.air.gusts > 0)
            criteria.push_back(unanswered(falls, "gusts keep the hair moving"));
        else if (run_.time.back() < *run_.stop + 2 * kWindow)
            criteria.push_back(unanswered(falls, "the file ends within 2 s of the stop"));
        else
            report_fall(falls, criteria);
        report_decay(criteria);
    }

  private:
    struct Wisp {
        double mass, length; // [kg], [m]
    };
    struct Peak {
        double energy = 0;
        Offender where;
    };

    void add_wisp(std::size_t w) {
        Wisp wisp{0, 0};
        for (std::size_t s = run_.groom.first_section[w] + 2; s < run_.groom.first_section[w + 1];
             ++s) {
            wisp.mass += section_mass(s);
            wisp.length += run_.groom.rest_length[s - 1];
        }
        wisps_.push_back(wisp);
        mass_ += wisp.mass;
    }

    double section_mass(std::size_t s) const {
        return run_.groom.skeleton_mass[s] +
               double{run_.groom.envelope_mass[s]} * run_.groom.envelope_points;
    }

    /// How fast the bodies carry and turn what they touch.
    void see_motion(const FrameView& view) {
        for (std::size_t b = 0; b < view.vertices.size() && !before_.empty(); ++b)
            for (std::size_t i = 0; i < view.vertices[b].size(); ++i) {
                const Vec3d moved = Vec3d(view.vertices[b][i]) + view.frame.origin -
                                    Vec3d(before_[b][i]) - origin_before_;
                speed_ = std::max(speed_, length(moved) / (view.time - time_before_));
            }
        for (const auto& bones : view.poses)
            for (const BonePose& bone : bones)
                turning_ = std::max(turning_, length(bone.angular_velocity));
        before_ = view.vertices, origin_before_ = view.frame.origin, time_before_ = view.time;
    }

    /// [J] of hair that moves with the fastest part of a body, turns with it at full length, is
    /// blown along, and falls by its length.
    double available_energy() const {
        const AirDesc& air = run_.simulation.air;
        const double wind = length(Vec3d(air.wind)) + 3 * double{air.gusts};
        const double gravity = length(Vec3d(run_.simulation.gravity));
        double sum = 0;
        for (const Wisp& w : wisps_) {
            const double v = speed_ + turning_ * w.length + wind;
            sum += w.mass * (v * v / 2 + gravity * w.length);
        }
        return sum;
    }

    void see_after_stop(const FrameView& view, double energy, const Offender& fastest) {
        after_stop_.emplace_back(view.time - *run_.stop, energy);
        const auto second = static_cast<std::size_t>((view.time - *run_.stop) / kWindow + 1e-6);
        if (peaks_.size() <= second)
            peaks_.resize(second + 1);
        if (energy > peaks_[second].energy)
            peaks_[second] = {energy, fastest};
    }

    void report_fall(const Question& falls, std::vector<Criterion>& criteria) const {
        // Within the first second a lifted wisp still falls: its peak is what the others are
        // measured by.
        const double quiet = mass_ * kQuietSpeed * kQuietSpeed / 2;
        Largest rise;
        rise.value = 0;
        for (std::size_t i = 1; i < peaks_.size(); ++i)
            if (peaks_[i].energy > quiet)
                rise.see(peaks_[i].energy / peaks_[i - 1].energy, peaks_[i].where);
        criteria.push_back(rise.value > 0 ? answered(falls, rise.value, rise.where)
                                          : answered(falls, 0, {}));
    }

    /// The energy swings between fall and motion, so it counts from its last large value on.
    void report_decay(std::vector<Criterion>& criteria) const {
        const char* name = "energy_decay";
        const char* meaning =
            "time after the motion stopped until kinetic energy stays under 1 % of the most since";
        double most = 0;
        for (const auto& [time, energy] : after_stop_)
            most = std::max(most, energy);
        double time_above = 0;
        for (const auto& [time, energy] : after_stop_)
            if (energy > kDecayed * most)
                time_above = time;
        if (after_stop_.empty() || time_above == after_stop_.back().first)
            criteria.push_back(unanswered({name, meaning, "s", 0}, "the file ends before"));
        else
            criteria.push_back(measured(name, meaning, "s", time_above,
                                        "wisps off, isotropic and as in the paper compare by it"));
    }

    const RunView& run_;
    std::vector<Wisp> wisps_;
    double mass_ = 0;
    Largest largest_;
    Offender fastest_;
    double speed_ = 0, turning_ = 0; // [m/s], [rad/s]
    std::vector<std::vector<Vec3>> before_;
    Vec3d origin_before_;
    double time_before_ = 0;
    std::vector<Peak> peaks_;                           // per second after the stop
    std::vector<std::pair<double, double>> after_stop_; // [s], [J]
};

} // namespace

JudgePointer energy_judge(const RunView& run) {
    return std::make_unique<EnergyJudge>(run);
}

} // namespace mane::judge
