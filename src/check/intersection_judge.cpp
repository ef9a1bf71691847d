#include "check/judge.h"
#include "check/overlap.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>

namespace mane::judge {
namespace {

constexpr double kAgreement =
    0.1; // the run counts at its detections and in its preroll, we in frames

/// M40: how many other segments a segment intersects, and whether the run counted the same.
class IntersectionJudge final : public Judge {
  public:
    explicit IntersectionJudge(const RunView& run) : run_(run) {}

    void see(const FrameView& view) override {
        const Overlaps overlaps(run_.groom, view.hair);
        for (std::size_t i = 0; i < overlaps.count().size(); ++i) {
            sum_ += overlaps.count()[i];
            most_.see(overlaps.count()[i],
                      offender(run_.groom, overlaps.segments()[i], view.number));
        }
        seen_ += overlaps.count().size();
    }

    void report(std::vector<Criterion>& criteria) const override {
        const double mean = seen_ > 0 ? static_cast<double>(sum_) / static_cast<double>(seen_) : 0;
        Criterion count = unanswered(
            {"intersections", "other segments that a segment intersects, on average", "1", 0},
            "a matter of style: it has no bound");
        count.value = mean;
        if (!most_.empty())
            count.worst = most_.where;
        criteria.push_back(count);

        const Question agreement{"intersections_agree",
                                 "the run's own count of them against this one, difference", "1",
                                 kAgreement};
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
    std::optional<double> counted_by_run() const {
        const auto json = nlohmann::json::parse(run_.statistics, nullptr, false);
        if (!json.is_object() || !json.contains("intersections_per_segment") ||
            !json["intersections_per_segment"].is_number())
            return std::nullopt;
        return json["intersections_per_segment"].get<double>();
    }

    const RunView& run_;
    std::uint64_t sum_ = 0, seen_ = 0;
    Largest most_;
};

} // namespace

JudgePointer intersection_judge(const RunView& run) {
    return std::make_unique<IntersectionJudge>(run);
}

} // namespace mane::judge
