#include "check/judge.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

namespace mane::judge {
namespace {

constexpr double kCrossing = 0.5; // sin 30°: M23's limit of quasi-parallel
constexpr double kAgreement =
    0.1; // the run counts at its detections and in its preroll, we in frames

/// On which side of segment a segment b passes it: the sign of the way between the closest points
/// of their axes, along the normal of both. None where these are not inside the two segments.
std::optional<bool> side(const HairGeometry& hair, std::size_t a, std::size_t b) {
    const Vec3d &a0 = hair.section(a).x, &b0 = hair.section(b).x;
    const Vec3d d = hair.section(a + 1).x - a0, e = hair.section(b + 1).x - b0, r = a0 - b0;
    const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), det = dd * ee - de * de;
    if (det <= 0)
        return std::nullopt;
    const double s = (de * dot(e, r) - ee * dot(d, r)) / det,
                 t = (dd * dot(e, r) - de * dot(d, r)) / det;
    if (s < 0 || s > 1 || t < 0 || t > 1)
        return std::nullopt;
    return dot(r, cross(d, e)) > 0;
}

/// M40: how many other segments a segment intersects, and whether the run counted the same. M41:
/// how many of them lie across it, and how often two such go through each other.
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
        sides_before_.swap(sides_);
        sides_.clear();
        for (const auto& [i, j] : overlaps.pairs()) {
            const std::uint32_t a = overlaps.segments()[std::min(i, j)],
                                b = overlaps.segments()[std::max(i, j)];
            if (lie_across(view.hair, a, b)) {
                crossings_ += 2; // each is one of the other's
                see_side(view.hair, a, b);
            }
        }
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

        const double seconds = run_.time.empty() ? 0 : run_.time.back() - run_.time.front();
        const double wisps = static_cast<double>(run_.groom.wisp_count());
        criteria.push_back(measured(
            "passages",
            "times per wisp and second that it goes through another that lies across it", "1/s",
            seconds > 0 ? 2 * static_cast<double>(passages_) / (wisps * seconds) : 0,
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
    /// From one frame to the next the axes of a pair changed sides: they went through each other.
    void see_side(const HairGeometry& hair, std::uint32_t a, std::uint32_t b) {
        const std::optional<bool> now = side(hair, a, b);
        if (!now)
            return;
        const auto before = sides_before_.find({a, b});
        passages_ += before != sides_before_.end() && before->second != *now;
        sides_[{a, b}] = *now;
    }

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
    std::uint64_t sum_ = 0, crossings_ = 0, passages_ = 0, seen_ = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> sides_, sides_before_;
    Largest most_;
};

} // namespace

JudgePointer intersection_judge(const RunView& run) {
    return std::make_unique<IntersectionJudge>(run);
}

} // namespace mane::judge
