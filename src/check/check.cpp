#include "mane/check.h"

#include "check/finite.h"
#include "check/judge.h"
#include "check/run_view.h"

#include <algorithm>
#include <stdexcept>

namespace mane {
namespace {

using namespace judge;

/// The bodies that hair must stay out of, each with its surface closed.
struct Bodies {
    std::vector<std::size_t> solid;
    std::vector<ClosedTopology> topology;

    explicit Bodies(const std::vector<Body>& bodies) {
        for (std::size_t b = 0; b < bodies.size(); ++b)
            if (!bodies[b].worn) {
                solid.push_back(b);
                topology.emplace_back(bodies[b].mesh);
            }
    }
    std::vector<Solid> posed(const std::vector<std::vector<Vec3>>& vertices) const {
        std::vector<Solid> solids;
        for (std::size_t i = 0; i < solid.size(); ++i)
            solids.emplace_back(topology[i], vertices[solid[i]]);
        return solids;
    }
};

Criterion judge_completeness(const RunView& run) {
    const Question question{"complete", "frames in the file; the scene asks for the bound", "1",
                            static_cast<double>(run.simulation.schedule.frames), Sense::at_least};
    Criterion c = answered(question, static_cast<double>(run.time.size()), {}, run.damage);
    if (!run.damage.empty())
        c.verdict = Verdict::fail;
    return c;
}

/// Frames with numbers that are not finite.
struct FiniteCount {
    std::size_t frames = 0;
    std::optional<Offender> first;

    /// Whether the frame can be judged.
    bool see(const RunView& run, const Frame& frame, const std::vector<std::vector<Vec3>>& vertices,
             std::uint32_t number) {
        const std::optional<std::size_t> bad = first_bad_section(run.groom, frame);
        if (!bad && all_finite(vertices))
            return true;
        ++frames;
        if (!first)
            first = bad ? offender(run.groom, *bad, number) : Offender{.frame = number};
        return false;
    }
    Criterion answer() const {
        const Question question{
            "finite", "frames with a number that is not finite, or a negative radius", "1", 0};
        return answered(question, static_cast<double>(frames), first,
                        first ? "the others are judged without them" : "");
    }
};

void show_frame(const CacheReader& cache, const RunView& run, const Bodies& bodies,
                std::uint32_t number, FiniteCount& finite, std::span<const JudgePointer> judges) {
    const Frame frame = cache.frame(number);
    std::vector<std::vector<Vec3>> vertices;
    for (std::size_t b = 0; b < run.bodies.size(); ++b)
        vertices.push_back(cache.body_vertices(number, b));
    if (!finite.see(run, frame, vertices, number))
        return;
    const BodyPoses poses = cache.poses(number);
    const HairGeometry hair(run.groom, frame);
    const Overlaps overlaps(run.groom, hair);
    const std::vector<Solid> solids = bodies.posed(vertices);
    const FrameView view{number, run.time[number], frame, hair, overlaps, poses, vertices, solids};
    for (const JudgePointer& judge : judges)
        judge->see(view);
}

} // namespace

CheckReport check_run(const CacheReader& cache, const CheckOptions& options) {
    const RunView run = view_run(cache, options);
    const Bodies bodies(run.bodies);
    std::vector<JudgePointer> judges;
    for (const auto make : {skeleton_judge, strand_judge, shape_judge, tip_judge, energy_judge,
                            rest_judge, intersection_judge, parting_judge})
        judges.push_back(make(run));

    FiniteCount finite;
    for (std::uint32_t i = 0; i < run.time.size(); ++i)
        show_frame(cache, run, bodies, i, finite, judges);

    CheckReport report;
    report.criteria = {judge_completeness(run), finite.answer()};
    if (finite.frames < run.time.size())
        for (const JudgePointer& judge : judges)
            judge->report(report.criteria);
    return report;
}

bool CheckReport::passed() const {
    return std::ranges::none_of(criteria,
                                [](const Criterion& c) { return c.verdict == Verdict::fail; });
}

const Criterion& CheckReport::operator[](std::string_view name) const {
    const auto found = std::ranges::find(criteria, name, &Criterion::name);
    if (found == criteria.end())
        throw std::out_of_range("no criterion " + std::string(name));
    return *found;
}

} // namespace mane
