// What detection passes over, it passes over rightly, in a whole run, to the bit:
// two runs side by side, of which one asks for every section what of the bodies it touches, have
// the same contacts with them at every detection and the same state after every block; and every
// segment's contacts with points of other wisps are those that testing all points of the hair
// against it finds.
//   nothing_missed SCENE.toml [seconds] [section.key=value ...]

#include "interactions/near_all.h"

#include "mane/scene.h"
#include "mane/setup.h"
#include "step/cast.h"
#include "step/placement.h"
#include "step/roots.h"
#include "step/step.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

using namespace mane;

bool same(const Rows& a, const Rows& b) {
    return std::equal(a.all().begin(), a.all().end(), b.all().begin(), b.all().end());
}
bool same(const State& a, const State& b) {
    return same(a.position, b.position) && same(a.velocity, b.velocity) &&
           same(a.radius, b.radius) && same(a.radius_rate, b.radius_rate);
}

/// Contacts of points between wisps, looked for a second time.
class PointSearch {
  public:
    explicit PointSearch(const ContactPoints& points)
        : points_(points), all_(test::near_all(points)) {}

    /// Whether a segment's contacts are those found among all points of the hair.
    bool same(std::uint32_t rank, std::span<const PointContact> contacts) {
        find(rank, all_);
        auto next = contacts.begin();
        for (std::size_t i = 0; i < found_.count; ++i) {
            if (!may_touch(points_.order.section(found_.point[i] / 16), rank))
                continue;
            if (next == contacts.end() || next->point != found_.point[i] ||
                next->s != found_.s[i] || std::fabs(next->density) != found_.density[i])
                return false;
            ++next;
        }
        return next == contacts.end();
    }

    /// Whether those near a box a tenth smaller than the segment's would be fewer.
    bool cut_short(std::uint32_t rank, const BoxTree& tree) {
        find(rank, all_);
        const std::size_t all = found_.count;
        Box box = segment_box(points_, rank);
        const Vec3 cut = (box.high - box.low) * 0.05f;
        box.low += cut;
        box.high += cut * -1.f;
        NearBoxes near;
        test_.gather(tree, box, near);
        find(rank, near);
        return found_.count < all;
    }

  private:
    void find(std::uint32_t rank, const NearBoxes& near) {
        test_.find(points_, {&rank, 1}, near, &found_);
    }

    // A section belongs to the simulated segments before and after it; of one wisp, two segments
    // must share no section (M22).
    bool may_touch(std::uint32_t section, std::uint32_t rank) const {
        const std::uint32_t at = points_.order.rank(section), segment = points_.order.section(rank);
        const auto apart = [&](std::uint32_t other) {
            return points_.wisp[at] != points_.wisp[rank] ||
                   std::max(other, segment) - std::min(other, segment) > 1;
        };
        const bool begins = points_.order.next(at) != ContactOrder::kNone, ends = !points_.held[at];
        return (begins && apart(section)) || (ends && apart(section - 1));
    }

    const ContactPoints& points_;
    NearBoxes all_;
    PointTest test_ = point_test_for("scalar");
    PointsInside found_;
};

/// The bodies' frames and the origin move as in a World.
class Pair {
  public:
    explicit Pair(const RunSetup& setup, const SimulationDesc& desc)
        : cast_(setup.bodies), runs_{Simulation(desc, setup.groom, {}),
                                     Simulation(desc, setup.groom, {})} {
        runs_[1].character_contacts = CharacterContacts({.clear_regions = false});
        const Vec3d origin = cast_.on_head(Vec3d(setup.groom.position[1]), 0);
        cast_.begin(0, origin);
        for (Simulation& run : runs_) {
            run.origin = origin;
            run.bodies = cast_.contact_bodies();
            place_groom(run, cast_, 0);
        }
    }

    /// False once anything is not the same.
    bool advance() {
        const Schedule& schedule = runs_[0].schedule;
        const std::uint64_t first = frame_++ * schedule.steps();
        const auto time = [&](std::uint64_t step) {
            return static_cast<double>(first + step) * schedule.step_seconds();
        };
        cast_.begin(time(0), runs_[0].origin);
        for (std::uint32_t b = 0; b < schedule.blocks(); ++b) {
            const std::uint32_t begin = schedule.block_begin(b), end = schedule.block_begin(b + 1);
            enter_block(time(begin), (end - begin) * schedule.step_seconds());
            StepPlace place{
                .index = 0, .steps = end - begin, .detects_wisps = schedule.detects_wisps(b)};
            for (; place.index < place.steps; ++place.index) {
                for (Simulation& run : runs_)
                    step(run, place, time(begin + place.index));
                if (place.first() && !same_contacts())
                    return false;
                if (place.first() && place.detects_wisps && !same_points())
                    return false;
            }
            if (!same(runs_[0].state, runs_[1].state))
                return false;
        }
        return true;
    }

    const Statistics& statistics() const { return runs_[0].statistics; }
    /// How many segments would have missed a contact if their boxes were a tenth smaller.
    std::size_t cut_short() const { return cut_short_; }

  private:
    void enter_block(double time, double seconds) {
        const auto follow = [&](int end) {
            for (Simulation& run : runs_)
                follow_scalp(run.groom, run.layout, cast_.body(0).mesh, cast_.vertices(0),
                             cast_.velocities(0), end, run.roots);
        };
        for (Simulation& run : runs_)
            run.roots.seconds = static_cast<float>(seconds);
        follow(0);
        cast_.advance(time + seconds, seconds, runs_[0].origin);
        follow(1);
    }

    bool same_contacts() const {
        for (std::size_t w = 0; w < runs_[0].groom.wisp_count(); ++w) {
            const auto a = runs_[0].character_contacts.of_wisp(w),
                       b = runs_[1].character_contacts.of_wisp(w);
            if (!std::equal(a.begin(), a.end(), b.begin(), b.end()))
                return false;
        }
        return true;
    }

    bool same_points() {
        const ContactPoints& points = runs_[0].contact_geometry.points();
        const ContactList& list = runs_[0].wisp_detection.list();
        PointSearch search(points);
        BoxTree tree;
        std::vector<Box> hulls(points.bunches());
        point_test_for("").hulls(points, hulls.data(), 0, hulls.size());
        tree.update(hulls);
        for (std::uint32_t rank = 0; rank < points.order.size(); ++rank) {
            const std::uint32_t next = points.order.next(rank);
            if (next == ContactOrder::kNone || points.held[next])
                continue;
            if (!search.same(rank, list.inside[rank]))
                return false;
            cut_short_ += search.cut_short(rank, tree);
        }
        return true;
    }

    Cast cast_;
    std::array<Simulation, 2> runs_;
    std::size_t cut_short_ = 0;
    std::uint64_t frame_ = 0;
};

} // namespace

int main(int argc, char** argv) {
    if (argc < 2)
        return std::fprintf(stderr,
                            "usage: nothing_missed SCENE.toml [seconds] [section.key=value ...]\n"),
               2;
    SceneDesc scene = read_scene(argv[1]);
    for (int i = 3; i < argc; ++i)
        apply_setting(scene, argv[i]);
    const double seconds = argc > 2 ? std::atof(argv[2]) : 11;
    Pair pair(prepare(scene), scene.simulation);
    const int frames = static_cast<int>(seconds * double{scene.simulation.schedule.frame_rate});
    for (int frame = 0; frame < frames; ++frame)
        if (!pair.advance())
            return std::fprintf(stderr, "not the same in frame %d\n", frame), 1;
    const Statistics& s = pair.statistics();
    std::printf("the same %llu sliding contacts, %llu reactions and %llu contacts between wisps at "
                "%llu detections; boxes a tenth smaller would have missed some of %zu segments\n",
                static_cast<unsigned long long>(s.sliding_contacts),
                static_cast<unsigned long long>(s.penetration_reactions),
                static_cast<unsigned long long>(s.friction_contacts + s.collision_contacts),
                static_cast<unsigned long long>(s.character_detections), pair.cut_short());
    return s.sliding_contacts > 0 && pair.cut_short() > 0 ? 0 : 1;
}
