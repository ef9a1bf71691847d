#include "check/judge.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace mane::judge {
namespace {

constexpr double kCrossing = 0.5; // sin 30°: M23's limit of quasi-parallel
constexpr double kAgreement =
    0.1; // the run counts at its detections and in its preroll, we in frames

/// M40: how many other segments a segment intersects, and whether the run counted the same. M41:
/// how many of them lie across it.
class IntersectionJudge final : public Judge {
  public:
    explicit IntersectionJudge(const RunView& run) : run_(run) {}

    void see(const FrameView& view) override {
        const Overlaps& overlaps = view.overlaps;
        for (std::size_t i = 0; i < overlaps.count().size(); ++i) {
            sum_ += overlaps.count()[i];
            most_.see(overlaps.count()[i],
                      offender(run_.groom, overlaps.segments()[i], view.number));
        }
        seen_ += overlaps.count().size();
        for (const auto& [a, b] : overlaps.pairs())
            if (lie_across(view.hair, overlaps.segments()[a], overlaps.segments()[b]))
                crossings_ += 2; // each is one of the other's
    }

    void report(std::vector<Criterion>& criteria) const override {
        const double mean = seen_ > 0 ? static_cast<double>(sum_) / static_cast<double>(seen_) : 0;
        Criterion count =
            measured("intersections", "other segments that a segment intersects, on average", "1",
                     mean, "a matter of style: it has no bound");
        if (!most_.empty())
            count.worst = most_.where;
        criteria.push_back(count);
        criteria.push_back(
            measured("crossings", "of them, those that lie across it by more than 30°", "1",
                     seen_ > 0 ? static_cast<double>(crossings_) / static_cast<double>(seen_) : 0,
                     "wisps off, isotropic and as in the paper compare by it"));

        const Question agreement{"intersections_agree",
                                 "the run's own count of them against this one, difference", "1",
                                 kAgreement};
        if (run_.simulation.wisps.mode == WispContactMode::off) {
            criteria.push_back(unanswered(agreement, "wisps are off: the run looks for none"));
            return;
        }
        const std::optional<double> own = counted_by_run();
        if (!own || mean == 0) {
            criteria.push_back(unanswered(agreement, own ? "nothing intersects"
                                                         : "the run's count is not in the file"));
            return;
        }
        char note[64];
        std::snprintf(note, sizeof note, "the run counted %.2f, we %.2f", *own, mean);
        criteria.push_back(answered(agreement, std::fabs(*own / mean - 1), {}, note));
    }

  private:
    static bool lie_across(const HairGeometry& hair, std::size_t a, std::size_t b) {
        const auto direction = [&](std::size_t s) {
            return normalized(hair.section(s + 1).x - hair.section(s).x);
        };
        return length(cross(direction(a), direction(b))) > kCrossing;
    }

    std::optional<double> counted_by_run() const {
        const auto json = nlohmann::json::parse(run_.statistics, nullptr, false);
        if (!json.is_object() || !json.contains("intersections_per_segment") ||
            !json["intersections_per_segment"].is_number())
            return std::nullopt;
        return json["intersections_per_segment"].get<double>();
    }

    const RunView& run_;
    std::uint64_t sum_ = 0, crossings_ = 0, seen_ = 0;
    Largest most_;
};

} // namespace

JudgePointer intersection_judge(const RunView& run) {
    return std::make_unique<IntersectionJudge>(run);
}

} // namespace mane::judge
